"""Why there is no solid, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from manifold3d import Error


class NoSolid(Exception):
    """A node that cannot be evaluated, in the user's words; it becomes a value of the memo."""


WORDS = {
    "NonFiniteVertex": "a vertex is not a finite point",
    "NotManifold": "the surface is not closed, or an edge has more than two faces",
    "VertexOutOfBounds": "a face names a point that does not exist",
    "PropertiesWrongLength": "the vertex properties have the wrong length",
    "MissingPositionProperties": "there are no vertex positions",
    "MergeVectorsDifferentLengths": "the vertices to be merged do not come in pairs",
    "MergeIndexOutOfBounds": "a vertex to be merged does not exist",
    "TransformWrongLength": "a transform has the wrong length",
    "RunIndexWrongLength": "the runs of triangles have the wrong length",
    "FaceIDWrongLength": "the face numbers have the wrong length",
    "InvalidConstruction": "the numbers make no solid: a size is 0 or below",
    "ResultTooLarge": "the result has too many triangles",
    "InvalidTangents": "the tangents are not valid",
    "Cancelled": "it was cancelled",
}


def words(error: Error) -> str:
    """manifold3d's status in words."""
    return WORDS.get(error.name, f"the solid kernel says {error.name}")
