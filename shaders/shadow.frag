#version 330 core
in float height;
out float shade;

void main() { shade = exp(-6.0 * max(height, 0.0)); }
