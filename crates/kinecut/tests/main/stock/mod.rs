//! The cut stock: contacts, faces, volumes.

mod contacts;
mod contacts_job;
mod edges;
mod steps;
mod volume;
