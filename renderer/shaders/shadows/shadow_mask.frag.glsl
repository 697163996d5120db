// Of shadow masks: bits that are set where the stencil says so.
layout(location = 0) out uint out_mask;
uniform uint bits;
void main() { out_mask = bits; }
