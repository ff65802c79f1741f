// A part of the scene. What stands out from a centre line (rope, mark) is widened to a least size on screen.
uniform mat4 to_clip;
uniform float pixel_angle; // size of a pixel at distance 1 [m]
uniform float least_px;    // least half width [px]
uniform float edge_px;     // how much wider than that an edge is [px]

in vec3 place;
in vec3 normal;
in float radius;
in vec4 colour;
in vec3 grain;

out vec3 world;
out vec3 outward;
out vec4 tint;
out vec3 own;

void main() {
    float pixel = pixel_angle * length(place - eye);
    float wide = radius > 0.0 ? max(radius, least_px * pixel) + edge_px * pixel : 0.0;
    world = place + normal * wide;
    outward = normal;
    tint = colour;
    own = grain;
    gl_Position = to_clip * vec4(world, 1.0);
}
