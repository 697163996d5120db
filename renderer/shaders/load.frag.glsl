// A load that no compiler can shorten: a chain of dependent steps per pixel.
uniform int steps;
layout(location = 0) out float result;

void main() {
    float x = fract(gl_FragCoord.x * 0.37 + gl_FragCoord.y * 0.11);
    for (int i = 0; i < steps; ++i)
        x = fract(3.9 * x * (1.0 - x) + 0.001);
    result = x;
}
