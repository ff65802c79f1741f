// Particles that drift with the water: points of a cell that repeats around the eye.
uniform mat4 to_clip;
uniform float pixel_angle; // size of a pixel at distance 1 [m]
uniform vec3 drift_m;      // path of the water since the start [m]
uniform vec3 right;        // across and up the picture
uniform vec3 up;

in vec3 seed;              // place in the cell, 0 to 1
in vec3 corner;            // of the particle's square, -1 to 1; its radius [m]

out vec2 spot;
out float dense;
out float height;

const float CELL_M = 8.0;

void main() {
    vec3 place = eye + CELL_M * (fract(seed + (drift_m - eye) / CELL_M) - 0.5);
    float far = length(place - eye);
    float wide = max(corner.z, 0.8 * pixel_angle * far);
    float thin = corner.z / wide;
    spot = corner.xy;
    height = place.z;
    dense = thin * thin * smoothstep(0.5 * CELL_M, 0.3 * CELL_M, far) * smoothstep(0.25, 0.8, far);
    dense *= step(place.z, -0.05);
    gl_Position = to_clip * vec4(place + wide * (corner.x * right + corner.y * up), 1.0);
}
