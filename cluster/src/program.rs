//! Which program a machine runs: executors, schedulers and those who ask for runs must be of one version.
//!
//! Each call to a scheduler names the program in its user agent, so that a foreign one is refused before it gets any
//! work; each part is asked for with the version too. Absent: the version of Ballista, which Ballista checks.

use ballista_core::extension::EndpointOverrideFn;
use phytomer::run::Program;
use std::sync::Arc;
use tonic::transport::Endpoint;
use tonic::{Request, Status};

/// What the user agent begins with.
const NAME: &str = "phytomer-cluster/";

/// The program in words, as the user agent has it.
pub fn named(program: &Program) -> String {
    format!("{NAME}{} ({})", program.version, program.git_hash)
}

/// Names the program in each call of a client.
pub fn naming(program: &Program) -> EndpointOverrideFn {
    let name = named(program);
    Arc::new(move |endpoint: Endpoint| Ok(endpoint.user_agent(name.as_str())?))
}

/// Lets calls of the same program pass, and refuses all others.
pub fn only(program: &Program) -> impl FnMut(Request<()>) -> Result<Request<()>, Status> + Clone + use<> {
    let own = named(program);
    move |request| {
        let there = request.metadata().get("user-agent").and_then(|name| name.to_str().ok()).unwrap_or_default();
        // tonic puts its own name behind.
        if there == own || there.starts_with(&format!("{own} ")) {
            return Ok(request);
        }
        let there = there.rsplit_once(" tonic/").map_or(there, |(name, _)| name);
        let there = if there.is_empty() { "a program without a name" } else { there };
        Err(Status::failed_precondition(format!(
            "the scheduler is {own}, and was called by {there}: install the same version on every machine of the cluster"
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(version: &str) -> Program {
        Program { version: version.to_owned(), git_hash: "abc".to_owned() }
    }

    fn call(agent: &str) -> Request<()> {
        let mut call = Request::new(());
        call.metadata_mut().insert("user-agent", agent.parse().unwrap());
        call
    }

    #[test]
    fn only_the_same_program_passes() {
        let mut only = only(&of("0.1.0"));
        assert!(only(call("phytomer-cluster/0.1.0 (abc) tonic/0.14.9")).is_ok());
        assert!(only(call("phytomer-cluster/0.1.0 (abc)")).is_ok());
        for foreign in
            ["phytomer-cluster/0.1.0 (abcd) tonic/0.14.9", "phytomer-cluster/0.2.0 (abc)", "tonic/0.14.9", ""]
        {
            let refused = only(call(foreign)).unwrap_err();
            assert_eq!(refused.code(), tonic::Code::FailedPrecondition, "{foreign}");
            assert!(refused.message().contains("the scheduler is phytomer-cluster/0.1.0 (abc)"), "{refused}");
        }
        let told = only(call("phytomer-cluster/0.2.0 (def) tonic/0.14.9")).unwrap_err();
        assert!(told.message().contains("called by phytomer-cluster/0.2.0 (def): install"), "{told}");
    }
}
