//! Strokes as convex pieces of the plan.
