//! Tests of all operators together.
