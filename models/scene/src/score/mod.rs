//! Scores of whole scenes: collisions, near misses, off-road driving, kinematics, goals.
