"""The shader that lights faces, as replacements of parts of VTK's own.

VTK lights every fragment, so that its "Gouraud" is Phong, and its highlight is that of the reflected ray. Here light
follows the equation of model/surface/intensity.py: at the vertices and interpolated (Gouraud 1971), at every fragment
(Phong 1975), or with one normal for each face (flat; a face near a point light is not all alike then).

Texture coordinates are found at every fragment from the place in the projection's frame, so that spheres and cylinders
have no seam: the angle is taken with its jump on either side, and that with the lesser derivative counts (Tarini 2012,
"Cylindrical and toroidal parameterizations without vertex seams"). Bump maps tilt the normal by the gradient on the
surface (Mikkelsen 2010, "Bump mapping unparametrized surfaces on the GPU"), which needs no tangents and holds for
mirrored coordinates too.
"""

from collections.abc import Sequence

from ...model.surface.light import MOST as MOST_LIGHTS
from ...model.surface.mapping import CAP, KINDS, TIE
from ...model.surface.material import SHADINGS

TABLE = "surfaceTable"
BITMAP = "surfaceBitmap"
SHADOW = "surfaceShadowMap"
POSITION, NUMBER = "surfacePosition", "surfaceNumber"
TEXELS = 8
"""Of four numbers each, for one surface in the table."""

CORNER_NORMALS = ("cornerNormalA", "cornerNormalB", "cornerNormalC")
CORNER_POINTS = ("cornerPointA", "cornerPointB", "cornerPointC")
CORNER_WEIGHTS = "cornerWeights"
_KIND = "\n".join(f"const int {kind.upper()} = {number};" for number, kind in enumerate(KINDS))
_SHADING = "\n".join(
    f"const int {shading.upper().replace('-', '_')} = {number};" for number, shading in enumerate(SHADINGS)
)


def lights(casting: Sequence[int] = ()) -> str:
    """How places receive light. VTK declares the uniforms that Surfaces.turn sets. The lights at the places `casting`
    have a shadow map each: nine of its texels say how much of a place is lit, which stands a little before its face
    then, so that no face shadows itself."""
    maps = "".join(f"uniform sampler2D {SHADOW}{i};\n" for i in range(len(casting)))
    lit = """float litBy(sampler2D map, vec4 at)
{
  vec3 place = 0.5 * at.xyz / at.w + 0.5;
  ivec2 size = textureSize(map, 0);
  if (size.x < 2 || any(lessThan(place, vec3(0.0))) || any(greaterThan(place, vec3(1.0)))) return 1.0;
  ivec2 texel = ivec2(place.xy * vec2(size));
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      sum += texelFetch(map, clamp(texel + ivec2(x, y), ivec2(0), size - 1), 0).r < place.z - 1e-3 ? 0.0 : 1.0;
  return sum / 9.0;
}
"""
    shares = {
        place: f"litBy({SHADOW}{i}, surfaceShadow{i} * vec4(world + surfaceOffset{i} * own, 1.0))"
        for i, place in enumerate(casting)
    }
    calls = "".join(
        f"  if (surfaceLights > {i}) lightUp(surfaceLight{i}, {shares.get(i, '1.0')} * surfaceGlow{i}, place, normal, "
        f"toEye, shininess);\n"
        for i in range(MOST_LIGHTS)
    )
    world = "  vec3 world = surfaceToWorld * place + surfaceEye, own = surfaceToWorld * normal;\n" if casting else ""
    return f"""{maps}{lit if casting else ""}
vec3 lightDiffuse, lightSpecular;
void lightUp(vec4 light, vec3 glow, vec3 place, vec3 normal, vec3 toEye, float shininess)
{{
  vec3 s = normalize(light.w > 0.5 ? light.xyz - place : light.xyz);
  float facing = dot(s, normal);
  if (facing > 0.0)
  {{
    lightDiffuse += glow * facing;
    lightSpecular += glow * pow(max(0.0, dot(normalize(s + toEye), normal)), shininess);
  }}
}}
vec3 towardsEye(vec3 place) {{ return surfaceParallel != 0 ? vec3(0.0, 0.0, 1.0) : normalize(-place); }}
void receiveLight(vec3 place, vec3 normal, float shininess)
{{
  vec3 toEye = towardsEye(place);
  lightDiffuse = vec3(0.0);
  lightSpecular = vec3(0.0);
{world}{calls}}}
"""


# At the vertices: the light on either side, diffuse and specular.
VERTEX_DECLARATIONS = """
out vec3 gouraudDiffuse, gouraudSpecular, gouraudDiffuseBack, gouraudSpecularBack;
void lightCorner(vec3 place, vec3 normal, float share, float shininess)
{
  receiveLight(place, normal, shininess);
  gouraudDiffuse += share * lightDiffuse;
  gouraudSpecular += share * lightSpecular;
  receiveLight(place, -normal, shininess);
  gouraudDiffuseBack += share * lightDiffuse;
  gouraudSpecularBack += share * lightSpecular;
}
"""
VERTEX_CLEAR = """
  gouraudDiffuse = gouraudSpecular = gouraudDiffuseBack = gouraudSpecularBack = vec3(0.0);
"""
VERTEX_LIGHTING = """  lightCorner((MCVCMatrix * vertexMC).xyz, normalize(normalMatrix * normalMC), 1.0, %s);
"""
# A fragment's corner takes the light between those at the corners of the triangle that it is a piece of. VTK may shift
# and scale the points that it draws, and its matrix with them, but not these.
PIECE_DECLARATIONS = "".join(f"in vec3 {name};\n" for name in (*CORNER_NORMALS, *CORNER_POINTS, CORNER_WEIGHTS))
PIECE_LIGHTING = "".join(
    f"  lightCorner(({point} - surfaceEye) * surfaceToWorld, normalize(normalMatrix * {normal}), "
    f"{CORNER_WEIGHTS}.{weight}, %s);\n"
    for normal, point, weight in zip(CORNER_NORMALS, CORNER_POINTS, "xyz", strict=True)
)
FRAGMENT_GOURAUD = "in vec3 gouraudDiffuse, gouraudSpecular, gouraudDiffuseBack, gouraudSpecularBack;\n"

FACE_NORMAL = """
  vec3 surfaceFace = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));
  vec3 surfaceToEye = towardsEye(vertexVC.xyz);
  if (dot(surfaceFace, surfaceToEye) < 0.0) surfaceFace = -surfaceFace;
"""

# What does not wear a material: its numbers stand in the shader.
PLAIN_LIGHTING = """
  float shininess = %(shininess).6f;
  vec3 lit = diffuseColor * %(ambient).6f * surfaceAmbient;
%(light)s
  lit += %(diffuse).6f * diffuseColor * lightDiffuse + %(specular).6f * lightSpecular;
  fragOutput0 = vec4(min(lit, vec3(1.0)), opacity);
"""
BY_FACE = "  receiveLight(vertexVC.xyz, surfaceFace, shininess);"
BY_FRAGMENT = "  receiveLight(vertexVC.xyz, normalVCVSOutput, shininess);"
BY_VERTEX = """  lightDiffuse = gl_FrontFacing ? gouraudDiffuse : gouraudDiffuseBack;
  lightSpecular = gl_FrontFacing ? gouraudSpecular : gouraudSpecularBack;"""

# What wears materials: the numbers of each stand in a row of the table.
DRESSED_VERTEX_DECLARATIONS = f"""
uniform sampler2D {TABLE};
in vec3 {POSITION};
in float {NUMBER};
out vec3 surfacePlace;
flat out float surfaceRow;
"""
DRESSED_VERTEX_PASSING = f"""
  surfacePlace = {POSITION};
  surfaceRow = {NUMBER};
  float surfaceShininess = texelFetch({TABLE}, ivec2(0, int({NUMBER} + 0.5)), 0).w;
"""


def dressed_declarations(bitmaps: int) -> str:
    """Of the fragment shader, for so many bitmaps."""
    chain = "".join(f"  if (slot == {i}) return textureGrad({BITMAP}{i}, at, across, down);\n" for i in range(bitmaps))
    samplers = "".join(f"uniform sampler2D {name};\n" for name in (TABLE, *(f"{BITMAP}{i}" for i in range(bitmaps))))
    return f"""
{samplers}in vec3 surfacePlace;
flat in float surfaceRow;
{_KIND}
{_SHADING}
const float TURN = 6.283185307179586;
vec4 bitmapAt(int slot, vec2 at, vec2 across, vec2 down)
{{
{chain}  return vec4(1.0);
}}
vec4 row(int place) {{ return texelFetch({TABLE}, ivec2(place, int(surfaceRow + 0.5)), 0); }}
// An angle in turns with its jump at 0 and at a half, and its derivatives where it does not jump.
void around(float y, float x, out float at, out float across, out float down)
{{
  float one = atan(y, x) / TURN;
  float other = fract(one + 1.0);
  bool jumps = fwidth(other) > fwidth(one) + 1e-6;
  at = other;
  across = jumps ? dFdx(one) : dFdx(other);
  down = jumps ? dFdy(one) : dFdy(other);
}}
int sideOf(vec3 normal)
{{
  vec3 size = abs(normal);
  int axis = size.z >= max(size.x, size.y) - {TIE} ? 2 : (size.y >= size.x - {TIE} ? 1 : 0);
  return 2 * axis + (normal[axis] < 0.0 ? 1 : 0);
}}
void project(int kind, vec3 extent, vec3 p, vec3 n, out vec2 at, out vec2 across, out vec2 down)
{{
  float jump, jumpAcross, jumpDown, tube, tubeAcross, tubeDown;
  around(p.y, p.x, jump, jumpAcross, jumpDown);
  around(p.z, length(p.xy) - extent.x, tube, tubeAcross, tubeDown);
  bool wall = false;
  if (kind == PLANAR) at = p.xy / extent.xy;
  else if (kind == BOX || kind == FACES)
  {{
    int side = sideOf(n);
    vec2 flat_ = side == 0 ? p.yz : side == 1 ? vec2(-p.y, p.z) : side == 2 ? vec2(-p.x, p.z)
               : side == 3 ? p.xz : side == 4 ? p.xy : vec2(-p.x, p.y);
    vec2 span = kind == BOX ? extent.xy : side < 2 ? extent.yz : side < 4 ? extent.xz : extent.xy;
    bool turned = kind == FACES && (side == 1 || side == 2 || side == 5);
    at = flat_ / span + vec2(turned ? 1.0 : 0.0, 0.0);
  }}
  else if (kind == CYLINDER && abs(n.z) > {CAP})
    at = vec2(n.z < 0.0 ? -p.x : p.x, p.y) / (2.0 * extent.y) + 0.5;
  else
  {{
    wall = true;
    at = vec2(jump, kind == SPHERICAL ? atan(p.z, length(p.xy)) * 2.0 / TURN + 0.5
                  : kind == TORUS ? tube : p.z / (kind == CYLINDRICAL ? extent.y : extent.x));
  }}
  across = dFdx(at);
  down = dFdy(at);
  if (wall)
  {{
    across.x = jumpAcross;
    down.x = jumpDown;
    if (kind == TORUS) {{ across.y = tubeAcross; down.y = tubeDown; }}
  }}
}}
"""


DRESSED_LIGHTING = """
  vec4 shares = row(0), ways = row(1), extents = row(2), first = row(3), second = row(4), maps = row(5), more = row(6);
  int shading = int(ways.y + 0.5);
  int kind = int(ways.z + 0.5);
  float shininess = shares.w;
  vec3 position = surfacePlace;
  float outwards = (gl_FrontFacing ? 1.0 : -1.0) * (extents.w < 0.0 ? -1.0 : 1.0);
  vec3 own = cross(dFdx(position), dFdy(position));
  own = outwards * own / max(length(own), 1e-30);
  vec2 st, stAcross, stDown;
  project(kind, extents.xyz, position, own, st, stAcross, stDown);
  mat2 bend = mat2(first.x, second.x, first.y, second.y);
  vec2 uv = bend * st + vec2(first.z, second.z);
  vec2 uvAcross = bend * stAcross, uvDown = bend * stDown;
  vec4 texel = bitmapAt(int(floor(first.w + 0.5)), uv, uvAcross, uvDown);
  vec3 base = diffuseColor * texel.rgb;
  float alpha = opacity * ways.x * texel.a;
  vec3 normal = shading == FLAT ? surfaceFace : normalVCVSOutput;
  if (shading == PHONG && second.w > -0.5)
  {
    vec2 slope = more.x * bitmapAt(int(second.w + 0.5), uv, uvAcross, uvDown).rg;
    vec3 right = dFdx(vertexVC.xyz), up = dFdy(vertexVC.xyz);
    float area = uvAcross.x * uvDown.y - uvAcross.y * uvDown.x;
    if (maps.x > 0.5 && abs(area) > 1e-20)  // of a normal map: rise by length, not by copies of the bitmap
      slope *= vec2(length(right * uvDown.y - up * uvAcross.y), length(up * uvAcross.x - right * uvDown.x)) / abs(area);
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 n = side * normal;
    vec3 one = cross(up, n), two = cross(n, right);
    float size = dot(right, one);
    vec3 gradient = sign(size) * (dot(slope, uvAcross) * one + dot(slope, uvDown) * two);
    normal = side * normalize(abs(size) * n - gradient);
  }
  float received = 1.0;
  if (maps.w > -0.5)
    received = dot(bitmapAt(int(maps.w + 0.5), uv, uvAcross, uvDown).rgb, vec3(0.2126, 0.7152, 0.0722));
  if (shading == GOURAUD || shading == GOURAUD_DIFFUSE)
  {
    lightDiffuse = gl_FrontFacing ? gouraudDiffuse : gouraudDiffuseBack;
    lightSpecular = gl_FrontFacing ? gouraudSpecular : gouraudSpecularBack;
    if (shading == GOURAUD_DIFFUSE) lightSpecular = vec3(0.0);
  }
  else receiveLight(vertexVC.xyz, normal, shininess);
  vec3 lit = shares.x * surfaceAmbient * base + received * (shares.y * base * lightDiffuse + shares.z * lightSpecular);
  lit = min(lit, vec3(1.0));
  vec3 mirrored = surfaceToWorld * reflect(-surfaceToEye, normal);
  float seen, seenAcross, seenDown;
  around(mirrored.y, mirrored.x, seen, seenAcross, seenDown);
  float height = asin(clamp(mirrored.z, -1.0, 1.0)) * 2.0 / TURN + 0.5;
  if (maps.y > -0.5)
  {
    vec3 room = bitmapAt(int(maps.y + 0.5), vec2(seen, height), vec2(seenAcross, dFdx(height)),
                         vec2(seenDown, dFdy(height))).rgb;
    lit = mix(lit, room, maps.z);
  }
  fragOutput0 = vec4(lit, alpha);
"""
