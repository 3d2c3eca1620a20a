"""The kinds of faults in words for the user, and counts of things."""

from __future__ import annotations

from dataclasses import dataclass

REPAIRS = {
    "weld": "Vertices within the tolerance become one, and open edges are joined to vertices beside them",
    "duplicates": "Of faces with the same corners one is kept",
    "slivers": "Faces thinner than the tolerance are taken out",
    "orient": "Faces are turned to agree with their neighbours, and outwards",
    "holes": "Borders are filled",
}
"""What can be asked for, in the order in which it is done, in words for the user."""


@dataclass(frozen=True, slots=True)
class KindWords:
    """A kind of findings: `count` is the count of a report that numbers all of it, `one` and `several` what it is
    called, `about` a sentence on what it is and what mends it, `mends` the names of the repairs that do."""

    count: str
    one: str
    several: str
    about: str
    mends: tuple[str, ...]

    def counted(self, count: int) -> str:
        return many(count, self.one, self.several)


MESH_KINDS = {
    "border": KindWords(
        "borders", "border", "borders",
        "Edges with a face on one side only, so that the surface encloses nothing; gaps within the tolerance are "
        "welded, holes are filled.",
        ("weld", "holes"),
    ),
    "overused edge": KindWords(
        "overused_edges", "edge of more than two faces", "edges of more than two faces",
        "More than two faces meet at one edge; duplicate faces may be the reason, else faces must be deleted by hand.",
        ("duplicates",),
    ),
    "turned edge": KindWords(
        "turned_edges", "edge between faces turned against each other", "edges between faces turned against each other",
        "The two faces disagree about which side is outside; turning one of them round mends it.",
        ("orient",),
    ),
    "crossing": KindWords(
        "crossings", "pair of faces that run into each other", "pairs of faces that run into each other",
        "Two faces cross, or lie in one another; no repair does that by itself: move vertices, or unite the pieces.",
        (),
    ),
    "duplicate": KindWords(
        "duplicates", "duplicate face", "duplicate faces",
        "A face with the same corners as another one; one of them is kept, and none where they stand back to back.",
        ("duplicates",),
    ),
    "degenerate": KindWords(
        "degenerate", "face without area", "faces without area",
        "Two corners of the face lie at one place; welding drops it.",
        ("weld",),
    ),
    "near vertex-edge": KindWords(
        "near_vertex_edge", "vertex near an edge", "vertices near an edge",
        "A vertex within the tolerance of an edge that it does not end; open edges are cut there and welded.",
        ("weld",),
    ),
    "near edge-edge": KindWords(
        "near_edge_edge", "pair of edges near each other", "pairs of edges near each other",
        "Two edges pass within the tolerance of each other and share no vertex; no repair does that by itself.",
        (),
    ),
    "near vertices": KindWords(
        "near_vertices", "pair of vertices near each other", "pairs of vertices near each other",
        "Two vertices within the tolerance that no edge joins; welding makes them one.",
        ("weld",),
    ),
    "sliver": KindWords(
        "slivers", "sliver", "slivers",
        "A face thinner than the tolerance; its short side is drawn together, or its long one laid across.",
        ("slivers",),
    ),
}  # fmt: skip
"""The kinds of findings in a mesh, worst first."""

DRAWING_KINDS = {
    "crossing": KindWords(
        "crossings", "crossing", "crossings",
        "Two lines cross between their ends; both are cut there.",
        ("cut",),
    ),
    "near end-segment": KindWords(
        "near_end_segment", "end beside a line", "ends beside a line",
        "An end lies within the tolerance of another line, or on it; that line is cut there and joined to it.",
        ("cut",),
    ),
    "near ends": KindWords(
        "near_ends", "pair of ends near each other", "pairs of ends near each other",
        "Two ends lie within the tolerance and are not joined; welding makes them one.",
        ("weld",),
    ),
    "open end": KindWords(
        "open_ends", "open end", "open ends",
        "One line alone ends here, so that the outline encloses nothing; join it to another end, or close it.",
        (),
    ),
    "duplicate": KindWords(
        "duplicates", "repeated line", "repeated lines",
        "A line with the ends of another one; one of them is kept.",
        ("weld",),
    ),
    "short": KindWords(
        "short", "short line", "short lines",
        "A line no longer than the tolerance; welding its ends drops it.",
        ("weld",),
    ),
}  # fmt: skip
"""The kinds of findings in a drawing, worst first."""


def many(count: int, word: str, plural: str = "") -> str:
    return f"{count:,} {word if count == 1 else plural or word + 's'}"
