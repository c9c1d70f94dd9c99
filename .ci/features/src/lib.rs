//! No code: the manifest beside this file chooses features of third-party crates for all builds of CI at once.
