"""Adapters to the simulators of others; each needs the packages of its simulator."""
