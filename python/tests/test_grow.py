"""Runs in memory and in folders: the same rows for every reader, faults, limits, Ctrl-C, threads, memory."""

import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import duckdb
import pandas
import polars
import pyarrow
import pyarrow.parquet

import phytomer as ph

SCENARIO = {
    "name": "trial",
    "species": "coffee",
    "plants": 6,
    "ages": {"until": 36, "record": [12, 36]},
}
# A run that goes on for long enough to be interrupted.
LONG = {"name": "long", "species": "coffee", "plants": 4000, "ages": {"until": 144, "record": list(range(6, 145, 6))}}
TABLES = ["components", "records", "events", "summary", "plants", "treatments", "site"]


def peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def resident_mb() -> float:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.run_of_memory = ph.grow(SCENARIO, seed=7)
        cls.run_of_folder = ph.grow(SCENARIO, seed=7, out=f"{cls.folder.name}/run")

    @classmethod
    def tearDownClass(cls) -> None:
        cls.folder.cleanup()

    def test_every_reader_has_the_cells_of_the_files(self) -> None:
        self.assertEqual(self.run_of_memory.tables, TABLES)
        for name in TABLES:
            parts = sorted(Path(self.folder.name, "run", name).glob("*.parquet"))
            written = pyarrow.concat_tables([pyarrow.parquet.read_table(part) for part in parts])
            for run in (self.run_of_memory, self.run_of_folder):
                t = run.table(name)
                with self.subTest(table=name, run=run.name):
                    read = pyarrow.table(t)
                    self.assertEqual(len(t), written.num_rows)
                    self.assertEqual(t.columns, written.column_names)
                    self.assertTrue(plain(read).equals(plain(written)), name)
                    # Each reader begins a stream of its own.
                    frame = polars.DataFrame(t)
                    self.assertTrue(plain(frame.to_arrow()).equals(plain(written)), name)
                    rows = duckdb.sql("SELECT * FROM t").to_arrow_table()
                    self.assertTrue(plain(rows).equals(plain(written)), name)
                    both = [plain(read).to_pandas(), plain(written).to_pandas()]
                    pandas.testing.assert_frame_equal(*both)

    def test_duckdb_counts_by_name(self) -> None:
        summary = self.run_of_memory.summary
        self.assertEqual(duckdb.sql("SELECT count(*), count(DISTINCT plant_id) FROM summary").fetchall(), [(12, 6)])
        self.assertEqual(summary.units["height_m"], "m")

    def test_a_table_is_handed_over_without_a_copy(self) -> None:
        records = self.run_of_memory.records
        first, second = pyarrow.table(records), pyarrow.table(records)
        addresses = [t.column("x_m").chunk(0).buffers()[1].address for t in (first, second)]
        self.assertEqual(addresses[0], addresses[1])

    def test_the_folder_is_that_of_the_command(self) -> None:
        path = Path(self.folder.name, "trial.toml")
        path.write_text(ph._toml(SCENARIO))
        out = Path(self.folder.name, "command")
        subprocess.run([sys.executable, "-m", "phytomer", "grow", path, "--seed", "7", "--out", out, "--quiet"], check=True)
        mine, theirs = ph.open(f"{self.folder.name}/run"), ph.open(out)
        for name in TABLES:
            self.assertTrue(pyarrow.table(mine.table(name)).equals(pyarrow.table(theirs.table(name))), name)
        self.assertEqual(ph.verify(out)["findings"], [])

    def test_unknown_tables_and_plants_are_told(self) -> None:
        with self.assertRaisesRegex(KeyError, "summary"):
            self.run_of_memory.table("sumary")
        with self.assertRaisesRegex(IndexError, "0 to 5"):
            self.run_of_memory.plant(6)
        lean = ph.grow(SCENARIO | {"tables": ["summary"]})
        with self.assertRaisesRegex(KeyError, "tables = "):
            _ = lean.records


class Faults(unittest.TestCase):
    def test_all_faults_at_once_with_their_places(self) -> None:
        text = 'name = "x"\nspecies = "coffe"\nplants = -1\nages = { until = 12 }'
        faults = ph.validate(text)
        self.assertEqual([(fault.file, fault.line) for fault in faults], [("scenario", 2), ("scenario", 3)])
        self.assertIn("coffee", faults[0].help)
        with self.assertRaises(ph.ScenarioError) as raised:
            ph.grow(text)
        self.assertEqual(raised.exception.faults, faults)
        self.assertIn("plants = -1", str(raised.exception))
        self.assertEqual(ph.validate(SCENARIO), [])
        self.assertTrue(ph.validate("no_such_plant"))

    def test_a_species_in_memory(self) -> None:
        species = {"inherits": "coffee", "name": "short_coffee"}
        run = ph.grow(SCENARIO | {"species": "short"}, files={"short": species})
        self.assertEqual(len(run.plants), 6)

    def test_folders_that_are_no_runs(self) -> None:
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(OSError):
            ph.open(folder)

    def test_a_limit_of_components_keeps_the_other_plots(self) -> None:
        with self.assertRaises(ph.LimitReached) as raised:
            ph.grow(SCENARIO | {"plants": 40, "limits": {"max_components": 1500}})
        run = raised.exception.run
        self.assertEqual(len(run.plants), 40)
        self.assertIn("max_components", str(raised.exception))

    def test_a_limit_of_memory_names_the_folder(self) -> None:
        with self.assertRaisesRegex(ph.LimitReached, "out="):
            ph.grow(SCENARIO | {"plants": 2000}, max_memory_mb=20)
        self.assertLess(peak_mb(), 2000)

    def test_wrong_arguments(self) -> None:
        with self.assertRaises(ValueError):
            ph.grow(SCENARIO, out="nowhere", resume=True, overwrite=True)
        with self.assertRaises(TypeError):
            ph.grow(SCENARIO, plants="six")


class Interrupts(unittest.TestCase):
    def setUp(self) -> None:
        # A shell starts what runs in its background with Ctrl-C ignored, and Python leaves that as it is.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)

    def interrupted(self, scenario: dict, **options: object) -> float:
        """Grows, hears Ctrl-C after half a second, and returns how many seconds later the exception came."""
        sent: list[float] = []

        def send() -> None:
            time.sleep(0.5)
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=send).start()
        with self.assertRaises(KeyboardInterrupt):
            ph.grow(scenario, **options)
        return time.monotonic() - sent[0]

    def test_ctrl_c_in_memory(self) -> None:
        print(f"Ctrl-C was raised after {self.interrupted(LONG):.3f} s")
        # What was interrupted is waited for, and the next run is whole.
        self.assertEqual(len(ph.grow(SCENARIO).plants), 6)

    def test_ctrl_c_leaves_a_folder_that_resumes(self) -> None:
        scenario = LONG | {"plants": 200}
        with tempfile.TemporaryDirectory() as folder:
            self.interrupted(scenario, out=f"{folder}/run")
            resumed = ph.grow(scenario, out=f"{folder}/run", resume=True)
            whole = ph.grow(scenario, out=f"{folder}/whole")
            for name in TABLES:
                self.assertTrue(pyarrow.table(resumed.table(name)).equals(pyarrow.table(whole.table(name))), name)
            self.assertEqual(ph.verify(f"{folder}/run")["findings"], [])

    def test_the_progress_of_a_run_stops_it(self) -> None:
        told: list[float] = []

        def progress(now: dict) -> None:
            told.append(now["share"])
            if len(told) > 3:
                raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            ph.grow(LONG, progress=progress)
        self.assertEqual(told, sorted(told))


class Threads(unittest.TestCase):
    def test_two_threads_grow_at_once(self) -> None:
        runs: dict[int, bytes] = {}
        ticks: list[float] = []

        def grow(seed: int) -> None:
            run = ph.grow(SCENARIO | {"plants": 200}, seed=seed, threads=1)
            runs[seed] = pyarrow.table(run.summary).to_pandas().to_csv().encode()

        threads = [threading.Thread(target=grow, args=(seed,)) for seed in (1, 2)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            ticks.append(time.monotonic())
            time.sleep(0.005)
        # The interpreter was free while both grew.
        self.assertGreater(len(ticks), 3)
        alone = ph.grow(SCENARIO | {"plants": 200}, seed=2)
        self.assertEqual(runs[2], pyarrow.table(alone.summary).to_pandas().to_csv().encode())
        self.assertNotEqual(runs[1], runs[2])


class Memory(unittest.TestCase):
    def test_nothing_is_left_of_many_runs(self) -> None:
        runs = int(os.environ.get("PHYTOMER_GROWS", "60"))
        small = SCENARIO | {"plants": 1, "ages": {"until": 12}}
        kept = []
        for at in range(runs):
            run = ph.grow(small, threads=1)
            pyarrow.table(run.components)
            run.plant(0).mesh(age=12).points.sum()
            if at in (runs // 3, runs - 1):
                kept.append(resident_mb())
        # A run of one small plant holds some hundred kB: a leak of each would be seen.
        self.assertLess(kept[1] - kept[0], 10, kept)


def plain(table: pyarrow.Table) -> pyarrow.Table:
    """The same cells without metadata and dictionaries, which readers keep in ways of their own."""
    columns = []
    for column in table.columns:
        if pyarrow.types.is_dictionary(column.type):
            column = column.cast(column.type.value_type)
        kind = column.type
        if pyarrow.types.is_large_string(kind) or str(kind) == "string_view":
            column = column.cast(pyarrow.string())
        columns.append(column.combine_chunks())
    return pyarrow.table(dict(zip(table.column_names, columns)))


if __name__ == "__main__":
    unittest.main()
