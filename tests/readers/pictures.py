"""Pillow reads a picture: pictures.py FILE WIDTH HEIGHT opaque|transparent

Its size and its channels are those stated; every byte of it decodes; an opaque picture has no opacity, a transparent one has
pixels that hide all, nothing and something in between. The file says what it shows.
"""

import sys

from PIL import Image

path, width, height, kind = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
with Image.open(path) as picture:
    picture.verify()
with Image.open(path) as picture:
    picture.load()
    assert picture.format == "PNG", picture.format
    assert picture.size == (width, height), picture.size
    assert picture.info["Software"] == "phytomer", picture.info
    assert "plants" in picture.info["Description"], picture.info
    colours = len(picture.convert("RGB").getcolors(1 << 24))
    assert colours > 100, f"only {colours} colours"
    if kind == "opaque":
        assert picture.mode == "RGB", picture.mode
    else:
        assert picture.mode == "RGBA", picture.mode
        opacity = picture.getchannel("A").tobytes()
        assert {0, 255} <= set(opacity), "nothing and all"
        assert any(0 < value < 255 for value in opacity), "edges and shadows"
print(path, picture.size, picture.mode, colours, "colours")
