"""The printed sheets: true to scale as PDF and as PNG, by what a detector finds on them."""

import re
import struct
import zlib

import numpy as np
import pytest

from agent.errors import ConfigError
from scene import edges, lens, markers, opencv, sheets

BOARD, MARKERS = sheets.sheets(50.0)


def drawn(data: bytes, page: int, per_mm=12):
    """A page of our PDF as a grey picture: its filled rectangles, by its own numbers."""
    boxes = re.findall(rb"MediaBox\[0 0 ([\d.]+) ([\d.]+)\]", data)
    width, height = (float(value) / 72 * 25.4 for value in boxes[page])
    content = data.split(b"stream\n")[2 * page + 1]
    scale = float(content.split()[1]) / 72 * 25.4
    picture = np.full((round(height * per_mm), round(width * per_mm)), 255, np.uint8)
    for text in re.findall(rb"([\d.]+) ([\d.]+) ([\d.]+) ([\d.]+) re f", content):
        x, y, wide, high = (float(value) * scale * per_mm for value in text)
        top = len(picture) - y - high
        picture[round(top) : round(top + high), round(x) : round(x + wide)] = 0
    return picture, (width, height)


def test_the_pdf_has_two_a4_pages_that_print_at_true_scale():
    data = sheets.pdf([BOARD, MARKERS])
    board, size = drawn(data, 0)
    assert size == pytest.approx((297, 210), abs=0.01)
    places, seen = opencv.find_board(board, lens.BOARD)
    assert len(places) == lens.CORNERS
    steps = (seen - seen[0]) / 12 - (places - places[0])
    assert np.abs(steps).max() < 0.05
    page, size = drawn(data, 1)
    assert size == pytest.approx((210, 297), abs=0.01)
    found = opencv.find_markers(page)
    assert set(found) == set(markers.CORNERS)
    for four in found.values():
        assert np.ptp(four, axis=0) / 12 == pytest.approx([50, 50], abs=0.1)
        assert four[0][0] < four[1][0] and four[0][1] < four[3][1]  # upright


def test_its_cross_reference_table_points_at_its_objects():
    data = sheets.pdf([BOARD, MARKERS])
    start = int(data.split(b"startxref\n")[1].split()[0])
    assert data[start : start + 4] == b"xref"
    places = re.findall(rb"(\d{10}) 00000 n", data)
    assert len(places) == 7
    for number, place in enumerate(places, 1):
        assert data[int(place) :].startswith(b"%d 0 obj" % number)


def test_the_png_says_how_many_pixels_a_metre_has():
    data = sheets.png(MARKERS)
    at = data.index(b"pHYs")
    across, down, unit = struct.unpack(">IIB", data[at + 4 : at + 13])
    assert (across, down, unit) == (12000, 12000, 1)
    assert struct.unpack(">I", data[at + 13 : at + 17])[0] == zlib.crc32(data[at : at + 13])
    picture = opencv.gray(opencv.decode(data))
    assert picture.shape == (297 * 12, 210 * 12)
    four = opencv.find_markers(picture)[40]
    assert np.ptp(four, axis=0) / across * 1000 == pytest.approx([50, 50], abs=0.1)


@pytest.mark.parametrize("page", [BOARD, MARKERS])
def test_the_ruler_is_a_hundred_millimetres_and_nothing_leaves_the_paper(page):
    marks = [box for box in page.boxes if box.width == 0.2 or box.height == 0.2]
    span = max(
        max(box.x + box.width for box in marks) - min(box.x for box in marks),
        max(box.y + box.height for box in marks) - min(box.y for box in marks),
    )
    assert span == pytest.approx(100) and len(marks) == 12
    for x, y, width, height in page.boxes:
        assert x > 4 and y > 4 and x + width < page.width - 4 and y + height < page.height - 4


def test_a_marker_that_does_not_fit_on_a4_is_refused():
    sheets.sheets(65.0)
    with pytest.raises(ConfigError, match="do not fit on A4"):
        sheets.sheets(75.0)


def test_words_stay_clear_of_the_board_and_of_where_edges_are_looked_for():
    for page in (BOARD, MARKERS):
        drawn_without = sheets.raster(page._replace(words=()))
        written = sheets.raster(page._replace(boxes=()))
        both = (drawn_without < 128) & (written < 128)
        assert not both.any()
    page = sheets.raster(MARKERS)
    for rough in opencv.find_markers(page).values():
        exact = edges.corners(page, rough, lambda pixels: pixels)
        assert np.ptp(exact, axis=0) / sheets.PER_MM == pytest.approx([50, 50], abs=0.1)
