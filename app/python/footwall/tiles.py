"""Pictures as the engine sends them: rows, packed."""
import zlib

import numpy

from .errors import Error


def put_tile(tile, rgba, depth):
    """A tile's rows into the picture."""
    height, width = depth.shape
    if tile.first_row < 0 or tile.rows < 0 or tile.first_row + tile.rows > height:
        raise Error("engine", "the engine sent rows that the picture does not have")
    size = 4 * tile.rows * width
    colours, depths = inflated(tile.colours, size), inflated(tile.depths, size)
    if len(colours) != size or len(depths) != size:
        raise Error("engine", "the engine sent a tile of another size")
    rows = slice(tile.first_row, tile.first_row + tile.rows)
    rgba[rows] = numpy.frombuffer(colours, dtype=numpy.uint8).reshape(-1, width, 4)
    depth[rows] = numpy.frombuffer(depths, dtype="<f4").reshape(-1, width)


def inflated(packed, most):
    """The bytes of a zlib stream, which may be `most` at most."""
    try:
        stream = zlib.decompressobj()
        plain = stream.decompress(packed, most + 1)
    except zlib.error as error:
        raise Error("engine", f"the engine sent what is no zlib stream: {error}") from None
    if len(plain) > most:
        raise Error("engine", "the engine sent more bytes than there can be")
    return plain
