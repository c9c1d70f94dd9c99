//! How fast a whole run of one big tree goes into its tables, against what the parquet crate alone needs for the same
//! batches with the same settings and threads. Usage: `records_rate [internodes in thousands] [threads] [runs] [0 to leave
//! parquet alone out]`, in release mode.
//!
//! The tree is not a species: a bush whose axes grow an internode with a leaf a tick, with noisy lengths and angles, so
//! that its columns are about as hard to compress as those of a real tree.

use arrow_array::RecordBatch;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_writer::{ArrowColumnWriter, compute_leaves};
use parquet::errors::ParquetError;
use phytomer_outputs::read::Run;
use phytomer_outputs::tables::{ROW_GROUP, arrow};
use phytomer_outputs::{Mode, Provenance, RunFolder, RunPlan, Table};
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::key::{Place, scramble};
use phytomer_sim::plant::{
    AxisId, Cause, Form, Habit, Kind, LineageKey, NewAxis, NewNode, NewOrgan, NodeId, Origin, Plant, Seed, Shape, Trend,
};
use phytomer_sim::site::Site;
use phytomer_sim::{Growth, GrowthModel, NEVER, Plot, Tick, grow};
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

const LAST: Tick = 50;

struct Bush {
    internodes: usize,
}

impl GrowthModel for Bush {
    fn growth(&self) -> Growth {
        Growth::Extends
    }

    fn habit(&self) -> Arc<Habit> {
        let trends = vec![Trend { cos_inclination: 0.9, sin_inclination: 0.435_889_9, share: 0.1 }];
        Arc::new(Habit { trends, shed_after: vec![NEVER], shapes: vec![Shape::Cone] })
    }

    fn sow(&self, plant: &mut Plant) {
        add_axis(plant, NodeId::NONE, LineageKey::SEED, 0, 1);
    }

    fn grow_to(&self, age: Tick, plants: &mut [Plant], _: &Site) -> Result<(), Overgrown> {
        for plant in plants {
            let mut waiting = vec![AxisId::TRUNK];
            while let Some(axis) = waiting.pop() {
                grow_axis(plant, axis, age, self.internodes, &mut waiting);
            }
            plant.age = age;
        }
        Ok(())
    }

    fn thicken(&self, age: Tick, plant: &mut Plant) {
        for node in 0..plant.nodes.len() {
            let years = age.saturating_sub(plant.nodes.birth[node]) as f32;
            plant.nodes.diameter[node] = plant.nodes.primary_diameter[node] * (1.0 + 0.1 * years);
            plant.nodes.diameter_tip[node] = plant.nodes.diameter[node] * 0.9;
        }
    }
}

fn grow_axis(plant: &mut Plant, axis: AxisId, age: Tick, most: usize, waiting: &mut Vec<AxisId>) {
    let (order, birth, key) =
        (plant.axes.order[axis.index()], plant.axes.birth[axis.index()], plant.axes.key[axis.index()]);
    let mut parent = plant.axes.bearer[axis.index()];
    for tick in birth + 1..=age {
        if plant.nodes.len() >= most {
            return;
        }
        let rank = tick - birth;
        let noise = scramble(key.0 ^ u64::from(rank));
        let share = |shift: u32| (noise >> shift & 0xffff) as f32 / 65536.0;
        let length = 0.05 + 0.05 * share(0);
        parent = plant.add_node(NewNode {
            parent,
            axis,
            birth: tick,
            rank,
            unit_rank: 1,
            short: false,
            neoformed: false,
            trend: 0,
            length,
            diameter: 0.002 + 0.002 * share(16),
            azimuth: 2.4 + share(32),
        });
        add_leaf(plant, parent, tick, share(0));
        if order < 6 && !noise.is_multiple_of(4) {
            waiting.push(add_axis(plant, parent, key.child(Place::Axillary(0).on(rank)), tick, order + 1));
        }
    }
}

fn add_axis(plant: &mut Plant, bearer: NodeId, key: LineageKey, tick: Tick, order: u8) -> AxisId {
    let share = (key.0 >> 20 & 0xffff) as f32 / 65536.0;
    plant.add_axis(NewAxis {
        bearer: bearer.some(),
        key,
        order,
        origin: if order == 1 { Origin::Seed } else { Origin::Axillary },
        position: 0,
        state: 0,
        appearance: tick,
        birth: tick,
        azimuth: std::f32::consts::TAU * share,
        insertion: if order == 1 { 0.0 } else { 0.6 + 0.3 * share },
    })
}

fn add_leaf(plant: &mut Plant, node: NodeId, tick: Tick, share: f32) {
    plant.add_organ(NewOrgan {
        node,
        kind: Kind::Leaf,
        position: 0,
        birth: tick,
        death: tick + 1,
        cause: Cause::Season,
        form: Form::Deltoid,
        length: 0.08,
        width: 0.07,
        area: 0.004,
        azimuth: std::f32::consts::TAU * share,
        insertion: 0.9,
    });
}

fn plan(internodes: usize) -> RunPlan {
    RunPlan {
        tables: vec![Table::Records, Table::Summary],
        recorded: (1..=10).map(|step| step * LAST / 10).collect(),
        until: LAST,
        plots: 1,
        plots_per_part: 1,
        compression_level: 1,
        precision_m: None,
        provenance: Provenance {
            scenario: format!("bush of {internodes} internodes"),
            treatment: "control".to_owned(),
            seed: 1,
            version: "0".to_owned(),
            git_hash: String::new(),
            resolved: serde_json::Value::Null,
            inputs: Vec::new(),
        },
    }
}

/// The processor time that this process has had, in seconds, where the system tells (Linux): steadier than the clock on
/// a machine that is shared.
fn processor_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |place: usize| fields.get(place).and_then(|field| field.parse::<f64>().ok()).unwrap_or(f64::NAN);
    (ticks(11) + ticks(12)) / 100.0
}

fn write_run(path: &Path, internodes: usize) -> f64 {
    let start = Instant::now();
    let folder = RunFolder::create(path, plan(internodes), Mode::Overwrite).expect("a run folder");
    let mut shard = folder.shard(0).expect("a shard");
    let model = Bush { internodes };
    let seed = Seed { plant: 0, run_seed: 1, component_limit: u32::MAX, keep_events: false };
    let mut plot = Plot::of_one(&model, &seed);
    let ending = grow(&model, &mut plot, LAST, &mut shard).expect("growth");
    println!("  grown and recorded  {:6.2} s", start.elapsed().as_secs_f64());
    shard.end_plot(&plot, ending).expect("an end");
    shard.commit().expect("a commit");
    folder.finish(&[]).expect("a finished run");
    start.elapsed().as_secs_f64()
}

fn encode(
    mut writer: ArrowColumnWriter,
    batch: &RecordBatch,
    place: usize,
) -> parquet::arrow::arrow_writer::ArrowColumnChunk {
    let write = |writer: &mut ArrowColumnWriter| -> Result<(), ParquetError> {
        for leaf in compute_leaves(batch.schema().field(place), batch.column(place))? {
            writer.write(&leaf)?;
        }
        Ok(())
    };
    write(&mut writer).expect("a column");
    writer.close().expect("a chunk")
}

/// The parquet crate alone: the columns of ready batches on all threads, with the settings of `records`.
fn write_alone(path: &Path, batches: &[RecordBatch], internodes: usize) -> f64 {
    let start = Instant::now();
    let properties = arrow::properties(Table::Records, &plan(internodes)).expect("settings");
    let file = std::fs::File::create(path).expect("a file");
    let writer = ArrowWriter::try_new(file, batches[0].schema(), Some(properties)).expect("a writer");
    let (mut file, factory) = writer.into_serialized_writer().expect("a writer");
    for (number, batch) in batches.iter().enumerate() {
        let columns = factory.create_column_writers(number).expect("column writers");
        let chunks: Vec<_> =
            columns.into_par_iter().enumerate().map(|(place, writer)| encode(writer, batch, place)).collect();
        let mut group = file.next_row_group().expect("a row group");
        for chunk in chunks {
            chunk.append_to_row_group(&mut group).expect("a write");
        }
        group.close().expect("a row group");
    }
    let file = file.into_inner().expect("a file");
    file.sync_all().expect("a sync");
    start.elapsed().as_secs_f64()
}

fn main() {
    let mut arguments = std::env::args().skip(1).map(|word| word.parse::<usize>().expect("a number"));
    let internodes = 1000 * arguments.next().unwrap_or(1000);
    let threads = arguments.next().unwrap_or(2);
    let runs = arguments.next().unwrap_or(3);
    let compare = arguments.next() != Some(0);
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().expect("a pool");
    let home = tempfile::tempdir().expect("a folder");
    for _ in 0..runs {
        let path = home.path().join("run");
        let before = processor_s();
        let ours = write_run(&path, internodes);
        let ours_processor = processor_s() - before;
        if !compare {
            println!("run {ours:.2} s, processor {ours_processor:.2} s");
            continue;
        }
        let run = Run::open(&path).expect("a run");
        let rows = run.rows().expect("rows")[&Table::Records];
        let bytes = run.json()["bytes"].as_u64().unwrap_or(0);
        let batches = run.batches_of(Table::Records, ROW_GROUP).expect("batches");
        let batches: Vec<_> = batches.collect::<Result<_, _>>().expect("batches");
        let before = processor_s();
        let alone = write_alone(&home.path().join("alone.parquet"), &batches, internodes);
        let alone_processor = processor_s() - before;
        let rate = |seconds: f64| rows as f64 / seconds / 1e6;
        println!(
            "{rows} rows, {:.1} bytes a row: run {ours:.2} s, {:.2} M rows/s; parquet alone {alone:.2} s, {:.2} M rows/s; \
             ratio {:.2}",
            bytes as f64 / rows as f64,
            rate(ours),
            rate(alone),
            ours / alone
        );
        println!("  processor: run {ours_processor:.2} s, parquet alone {alone_processor:.2} s");
    }
}
