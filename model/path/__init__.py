"""Paths of segments that keep their kind: flattening, fitting, editing, offsets (by manifold3d too). May import `curve`
and `spline`."""
