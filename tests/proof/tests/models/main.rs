//! Generated and generic models: against each other, against independent numbers and derivations by hand, and the laws
//! of mechanics.

mod batch;
mod capture;
mod closed_form;
mod control;
mod coordinates;
mod equivalence;
mod float;
mod generic;
mod graph_batches;
mod graph_models;
mod identities;
mod integrators;
mod light_last_link;
mod not_a_number;
mod references;
mod scalars;
mod short_links;
mod single_precision;
mod strange_masses;
mod trajectory;
