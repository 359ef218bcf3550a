//! Oriented boxes: the outlines of road users.
