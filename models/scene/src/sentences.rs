//! The sentences of a scene that is refused.

crate::messages! {
    agents_over_limit(agents: usize, most: usize) = "agents-over-limit", "{agents} agents; at most {most}";
    points_out_of_range(count: usize, least: usize, most: usize) =
        "points-out-of-range",
        [count] "{count} point; {least} to {most} expected",
        "{count} points; {least} to {most} expected";
}
