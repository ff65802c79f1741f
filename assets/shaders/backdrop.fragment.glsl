// Open water, lighter towards the surface; air above it.
in vec3 sight;

out vec4 shown;

void main() {
    shown = vec4(backdrop(normalize(sight)), 1.0);
}
