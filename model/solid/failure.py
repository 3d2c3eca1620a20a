"""What an evaluation says instead of a solid."""

from __future__ import annotations

from dataclasses import dataclass

from manifold3d import Error


class NoSolid(Exception):
    """A node that cannot be evaluated, in the user's words; it becomes a Failure value."""


@dataclass(frozen=True, slots=True)
class Failure:
    """Why there is no solid. `own` is False where only an operand is to blame."""

    message: str
    own: bool = True


WORDS = {
    Error.NonFiniteVertex: "a vertex is not a finite point",
    Error.NotManifold: "the surface is not closed, or an edge has more than two faces",
    Error.VertexOutOfBounds: "a face names a point that does not exist",
    Error.PropertiesWrongLength: "the vertex properties have the wrong length",
    Error.MissingPositionProperties: "there are no vertex positions",
    Error.MergeVectorsDifferentLengths: "the vertices to be merged do not come in pairs",
    Error.MergeIndexOutOfBounds: "a vertex to be merged does not exist",
    Error.TransformWrongLength: "a transform has the wrong length",
    Error.RunIndexWrongLength: "the runs of triangles have the wrong length",
    Error.FaceIDWrongLength: "the face numbers have the wrong length",
    Error.InvalidConstruction: "the numbers make no solid: a size is 0 or below",
    Error.ResultTooLarge: "the result has too many triangles",
    Error.InvalidTangents: "the tangents are not valid",
    Error.Cancelled: "it was cancelled",
}


def words(error: Error) -> str:
    """manifold3d's status in words."""
    return WORDS.get(error, f"the solid kernel says {error.name}")
