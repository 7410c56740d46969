//! Tests of the terrain readers.
