//! The plan as bytes, on its way to a scheduler and to executors.
//!
//! The operator that grows is written as a line of its own before JSON; everything else is Ballista's, and is handed to
//! its codec. The line has the version of this format, not of the program: an executor of another version shall be able
//! to read what it is asked for, and say that it is foreign.

use super::order::Order;
use super::plan::GrowExec;
use super::worker::Worker;
use ballista_core::serde::BallistaPhysicalExtensionCodec;
use datafusion::common::{Result, internal_err};
use datafusion::error::DataFusionError;
use datafusion::execution::TaskContext;
use datafusion::physical_plan::ExecutionPlan;
use datafusion_proto::physical_plan::{PhysicalExtensionCodec, PhysicalProtoConverterExtension};
use std::sync::Arc;

/// What the bytes of our operator begin with. No plan of Ballista does: it begins with the tag of a field that holds a
/// message (wire type 2), and `p` is the tag of one that holds a number (wire type 0).
const MAGIC: &[u8] = b"phytomer-cluster plan 1\n";

/// Ballista's codec, and ours for the operator that grows.
#[derive(Debug, Default)]
pub struct Codec {
    others: BallistaPhysicalExtensionCodec,
    worker: Option<Arc<Worker>>,
}

impl Codec {
    /// For an executor.
    pub fn of(worker: Arc<Worker>) -> Self {
        Self { worker: Some(worker), ..Self::default() }
    }
}

impl PhysicalExtensionCodec for Codec {
    fn try_decode(
        &self,
        bytes: &[u8],
        inputs: &[Arc<dyn ExecutionPlan>],
        context: &TaskContext,
        converter: &dyn PhysicalProtoConverterExtension,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let Some(order) = bytes.strip_prefix(MAGIC) else {
            return self.others.try_decode(bytes, inputs, context, converter);
        };
        let order: Order = serde_json::from_slice(order).map_err(|error| DataFusionError::External(error.into()))?;
        let [rows] = inputs else {
            return internal_err!("GrowExec has one child, and got {}", inputs.len());
        };
        Ok(Arc::new(GrowExec::new(Arc::clone(rows), Arc::new(order), self.worker.clone())))
    }

    fn try_encode(
        &self,
        node: Arc<dyn ExecutionPlan>,
        bytes: &mut Vec<u8>,
        converter: &dyn PhysicalProtoConverterExtension,
    ) -> Result<()> {
        let Some(grow) = node.downcast_ref::<GrowExec>() else {
            return self.others.try_encode(node, bytes, converter);
        };
        bytes.extend_from_slice(MAGIC);
        serde_json::to_writer(bytes, grow.order()).map_err(|error| DataFusionError::External(error.into()))
    }
}
