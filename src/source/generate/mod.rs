//! Terrain and vectors made from numbers, the same bits on every machine.
