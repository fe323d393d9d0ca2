"""Removes color information from PNG files."""

import struct

SIGNATURE = 8
CURVE = (b"gAMA", b"sRGB", b"iCCP", b"cHRM")


def strip_curve(path):
    """Removes the chunks about the transfer curve, so that a viewer treats the
    bytes as sRGB, whatever they are."""
    data = path.read_bytes()
    kept, at = data[:SIGNATURE], SIGNATURE
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        end = at + 12 + length
        if kind not in CURVE:
            kept += data[at:end]
        at = end
    path.write_bytes(kept)
