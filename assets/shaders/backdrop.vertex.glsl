// The whole picture, behind everything.
uniform vec3 right;  // from the middle of the picture to its edges, one unit ahead of the eye
uniform vec3 up;
uniform vec3 ahead;

in vec2 corner;

out vec3 sight;

void main() {
    sight = ahead + corner.x * right + corner.y * up;
    gl_Position = vec4(corner, 0.0, 1.0);
}
