//! The scene file: what a person wrote, checked.
