"""The bitmap inspector: a bitmap's pixels, and pages on its header, bytes, palette, memory, depth, losses, tiles."""
