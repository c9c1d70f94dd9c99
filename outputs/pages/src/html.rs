//! The file of a page: one HTML text that holds its style, its scripts and its data, and that asks for nothing else.
//!
//! A content security policy forbids everything (`default-src 'none'`) but the scripts and the style of the page, which
//! it names by their SHA-256. The data are compressed as gzip (RFC 1952) by miniz, whose bytes are the same on every
//! machine, and stand in base64 (RFC 4648) in a block that the browser does not run. Absent: what the data are.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::deflate::compress_to_vec;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::io::{self, Write};

/// The scripts, in the order in which they run.
const SCRIPTS: [&str; 12] = [
    include_str!("web/data.js"),
    include_str!("web/records.js"),
    include_str!("web/states.js"),
    include_str!("web/light.js"),
    include_str!("web/shaders.js"),
    include_str!("web/drawing.js"),
    include_str!("web/values.js"),
    include_str!("web/places.js"),
    include_str!("web/scene.js"),
    include_str!("web/panel.js"),
    include_str!("web/gestures.js"),
    include_str!("web/page.js"),
];
const STYLE: &str = include_str!("web/page.css");
const BODY: &str = include_str!("web/page.html");

/// How hard the data are compressed, of 10.
const EFFORT: u8 = 9;
/// The length of a line of data.
const LINE: usize = 7680;

/// Writes a page with a title, a description of its data and the streams that it describes.
///
/// # Errors
/// Those of `out`.
pub fn write<'a>(
    title: &str,
    header: &Value,
    streams: impl Iterator<Item = &'a [u8]>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let header = header.to_string();
    let mut data = (header.len() as u32).to_le_bytes().to_vec();
    data.extend_from_slice(header.as_bytes());
    streams.for_each(|stream| data.extend_from_slice(stream));
    let packed = gzip(&data);
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text.as_bytes())));
    let scripts: Vec<String> = SCRIPTS.iter().map(|script| hash(script)).collect();
    let policy = format!(
        "default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri 'none'; form-action 'none'",
        scripts.join(" "),
        hash(STYLE)
    );
    let title = escaped(title);
    write!(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"generator\" content=\"phytomer {}\">\n\
         <link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n{BODY}",
        env!("CARGO_PKG_VERSION")
    )?;
    writeln!(out, "<script type=\"application/gzip;base64\" id=\"data\">")?;
    for line in packed.chunks(LINE / 4 * 3) {
        writeln!(out, "{}", base64(line))?;
    }
    writeln!(out, "</script>")?;
    for script in SCRIPTS {
        writeln!(out, "<script>{script}</script>")?;
    }
    writeln!(out, "</body>\n</html>")
}

/// Some bytes as a gzip file without a name and a time.
fn gzip(data: &[u8]) -> Vec<u8> {
    let mut file = vec![0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 2, 255];
    file.extend_from_slice(&compress_to_vec(data, EFFORT));
    file.extend_from_slice(&crc32fast::hash(data).to_le_bytes());
    file.extend_from_slice(&(data.len() as u32).to_le_bytes());
    file
}

fn base64(bytes: &[u8]) -> String {
    STANDARD.encode(bytes)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vectors of RFC 4648 §10.
    #[test]
    fn base64_is_that_of_its_standard() {
        let pairs =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in pairs {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
        assert_eq!(base64(&[0xfb, 0xff]), "+/8=");
    }

    /// No script or style holds what would end its element, and a title cannot break out of its own.
    #[test]
    fn a_page_asks_for_nothing_and_names_its_scripts() {
        let mut page = Vec::new();
        write("<b> & co", &serde_json::json!({}), std::iter::empty(), &mut page).unwrap();
        let page = String::from_utf8(page).unwrap();
        assert!(page.contains("<title>&lt;b&gt; &amp; co</title>"));
        assert!(SCRIPTS.iter().all(|script| !script.contains("</script") && !script.contains("<!--")));
        assert!(!STYLE.contains("</style") && !BODY.contains("style=") && !BODY.contains("onclick"));
        assert_eq!(page.matches("'sha256-").count(), SCRIPTS.len() + 1);
        assert_eq!(page.matches("<script").count(), SCRIPTS.len() + 1);
        assert!(!page.contains("unsafe-"));
        for asking in ["src=\"", "@import", "url(", "fetch(", "XMLHttpRequest", "WebSocket", "import("] {
            assert!(!page.contains(asking), "{asking}");
        }
    }
}
