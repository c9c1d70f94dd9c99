//! Files are read by png's own decoder, and their data are held against miniz at the level that was asked for.

use super::{Compression, file, filtered, write_deflated};
use png::{ColorType, Decoder, Encoder};
use std::io::Cursor;

const SIZE: [u32; 2] = [61, 40];

/// A soft slope with edges in it: some rows gain by one filter, some by another.
fn pixels() -> Vec<u8> {
    let [width, height] = SIZE;
    let channel =
        |x: u32, y: u32, c: u32| if (x / 9 + y / 7).is_multiple_of(2) { 3 * x + 2 * y + 40 * c } else { x * x + 5 * y };
    (0..height).flat_map(|y| (0..width).flat_map(move |x| (0..3).map(move |c| channel(x, y, c) as u8))).collect()
}

fn pixels_of(file: &[u8]) -> (Vec<u8>, Option<String>) {
    let mut reader = Decoder::new(Cursor::new(file)).read_info().expect("an info");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("a picture");
    reader.finish().expect("an end");
    let note = reader.info().uncompressed_latin1_text.first().map(|chunk| chunk.text.clone());
    (pixels, note)
}

/// A file with a note behind its data, of several chunks of data.
fn of_another(level: png::Compression) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, SIZE[0], SIZE[1]);
    encoder.set_color(ColorType::Rgb);
    encoder.set_compression(level);
    let mut writer = encoder.write_header().expect("a header");
    let mut stream = writer.stream_writer_with_size(200).expect("a stream");
    std::io::Write::write_all(&mut stream, &pixels()).expect("its data");
    stream.finish().expect("its end");
    writer.write_text_chunk(&png::text_metadata::TEXtChunk::new("Comment", "behind")).expect("a note");
    writer.finish().expect("its end");
    bytes
}

/// The data of a file's chunks of this name.
fn chunks(file: &[u8], name: &[u8; 4]) -> Vec<Vec<u8>> {
    let mut rest = &file[8..];
    let mut found = Vec::new();
    while let Some(length) = rest.first_chunk() {
        let length = u32::from_be_bytes(*length) as usize;
        if &rest[4..8] == name {
            found.push(rest[8..8 + length].to_vec());
        }
        rest = &rest[12 + length..];
    }
    found
}

#[test]
fn a_file_has_its_pixels() {
    let written = file(SIZE, ColorType::Rgb, &pixels()).expect("a file");
    assert_eq!(pixels_of(&written).0, pixels());
}

#[test]
fn too_few_bytes_are_told() {
    assert!(file(SIZE, ColorType::Rgba, &pixels()).is_err());
}

#[test]
fn every_chunk_but_the_data_stays() {
    for compression in [png::Compression::Fast, png::Compression::Balanced, png::Compression::High] {
        let first = of_another(compression);
        assert!(chunks(&first, b"IDAT").len() > 1);
        let mut again = Vec::new();
        write_deflated(&first, Compression::Balanced, &mut again).expect("a file");
        assert_eq!(pixels_of(&again), (pixels(), Some("behind".to_owned())));
        let data = chunks(&again, b"IDAT");
        assert_eq!(data.len(), 1);
        let rows = miniz_oxide::inflate::decompress_to_vec_zlib(&chunks(&first, b"IDAT").concat()).expect("rows");
        assert_eq!(data[0], miniz_oxide::deflate::compress_to_vec_zlib(&rows, 6));
        // Once more changes nothing.
        let mut twice = Vec::new();
        write_deflated(&again, Compression::Balanced, &mut twice).expect("a file");
        assert_eq!(twice, again);
    }
}

/// Rows are filtered one way at every level, so the same pixels have the same bytes whoever has deflated them before.
#[test]
fn the_first_compressor_leaves_no_trace() {
    let file_of = |compression: Option<png::Compression>| {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, SIZE[0], SIZE[1]);
        encoder.set_color(ColorType::Rgb);
        match compression {
            Some(compression) => encoder.set_compression(compression),
            None => encoder = filtered(encoder),
        }
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&pixels()).expect("its data");
        writer.finish().expect("its end");
        let mut out = Vec::new();
        write_deflated(&bytes, Compression::High, &mut out).expect("a file");
        out
    };
    assert_eq!(file_of(None), file_of(Some(png::Compression::Balanced)));
    assert_eq!(file_of(None), file_of(Some(png::Compression::High)));
}

#[test]
fn what_is_no_png_is_told() {
    let whole = of_another(png::Compression::Balanced);
    let mut broken = whole.clone();
    // The second byte of the deflated data: its header's check fails.
    let place = whole.windows(4).position(|name| name == b"IDAT").expect("data") + 5;
    broken[place] ^= 1;
    let mut of_great_length = whole.clone();
    of_great_length[8..12].fill(255);
    for bad in [&b"GIF89a"[..], &[], &whole[..whole.len() - 1], &whole[..60], &broken, &of_great_length] {
        let error = write_deflated(bad, Compression::Balanced, std::io::sink()).expect_err("no PNG");
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidData);
    }
}
