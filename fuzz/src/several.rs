//! An input of several files: each stands behind a line `=== NAME`.

/// What stands before the name of a file, at the beginning of a line.
const FILE: &str = "=== ";

/// The files of an input.
pub fn files(data: &[u8]) -> Vec<(String, &[u8])> {
    let mut files: Vec<(String, &[u8])> = Vec::new();
    let mut rest = data;
    while let Some(start) = find(rest) {
        let behind = &rest[start + FILE.len()..];
        let line = behind.iter().position(|byte| *byte == b'\n').unwrap_or(behind.len());
        let content = behind.get(line + 1..).unwrap_or_default();
        let length = find(content).unwrap_or(content.len());
        files.push((String::from_utf8_lossy(&behind[..line]).trim().to_owned(), &content[..length]));
        rest = &content[length..];
    }
    files
}

/// Where the next file begins.
fn find(data: &[u8]) -> Option<usize> {
    let is_start = |at: usize| at == 0 || data[at - 1] == b'\n';
    (0..data.len()).find(|at| is_start(*at) && data[*at..].starts_with(FILE.as_bytes()))
}
