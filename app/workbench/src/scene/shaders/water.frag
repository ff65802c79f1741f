// Water: lighter towards the top of the picture.
uniform vec3 water_low;
uniform vec3 water_high;
uniform float height_px;

out vec4 shown;

void main() {
    shown = vec4(mix(water_low, water_high, gl_FragCoord.y / height_px), 1.0);
}
