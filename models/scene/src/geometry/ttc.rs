//! Time to collision of two boxes at constant velocity.
