"""Tests of the derivation; run with `cargo test` or `python -m codegen --test`."""
