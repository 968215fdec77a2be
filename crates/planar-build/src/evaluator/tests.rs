use super::*;
use crate::graph;
use std::sync::Arc;

#[test]
fn placeholder() {
    let _ = (graph::read_any, Arc::new(0));
}
