//! Where the library is, if a dependency has another name for it.
//!
//! Generated code says `::dvi_core`. Where there is no such crate, the compiler says that of each path, and
//! not what to write. Stable Rust tells a macro nothing of the names that it can use, but the compiler that
//! runs the macro was started with them: `--extern name=path`.

use proc_macro2::{Ident, Span};
use syn::{Path, parse_quote};

use super::Attribute;
use crate::errors::Errors;

const LIBRARY: &str = "dvi_core";

impl Attribute {
    /// Reports a library with another name, unless that is written.
    pub(super) fn admit_library(&mut self, errors: &mut Errors) {
        let arguments = std::env::args_os().filter_map(|argument| argument.into_string().ok());
        if let (None, Some(name)) = (&self.crate_path, other_name(arguments)) {
            let message = format!(
                "this library is the dependency `{name}` here, and its attributes have to know: write \
                 `crate = ::{name}` among the arguments"
            );
            errors.push_syn(syn::Error::new(Span::call_site(), message));
            self.crate_path = Some(path(&name));
        }
    }
}

fn path(name: &str) -> Path {
    let name = Ident::new(name, Span::call_site());
    parse_quote!(::#name)
}

/// The name that the arguments of the compiler have for the library, if its own is not among them.
fn other_name(arguments: impl Iterator<Item = String>) -> Option<String> {
    let mut other = None;
    let mut is_next = false;
    for argument in arguments {
        let dependency = match argument.strip_prefix("--extern=") {
            Some(dependency) => Some(dependency),
            None => is_next.then_some(argument.as_str()),
        };
        is_next = argument == "--extern";
        let Some((name, file)) = dependency.and_then(|dependency| dependency.split_once('=')) else {
            continue;
        };
        // `priv:name`
        let name = name.rsplit(':').next().unwrap_or(name);
        if name == LIBRARY {
            return None;
        }
        let file = file.rsplit(['/', '\\']).next().unwrap_or(file);
        let stem = file.split(['-', '.']).next().unwrap_or(file);
        if stem.strip_prefix("lib") == Some(LIBRARY) && syn::parse_str::<Ident>(name).is_ok() {
            other = Some(name.to_string());
        }
    }
    other
}

#[test]
fn the_name_of_a_renamed_dependency_is_found() {
    let named = |arguments: &str| other_name(arguments.split(' ').map(str::to_string));
    let with_others = "rustc --extern mechanics=/a-b/libdvi_core-0f.rmeta --extern syn=libsyn.rlib";
    assert_eq!(named(with_others).as_deref(), Some("mechanics"));
    assert_eq!(named("rustc --extern=priv:m=deps/libdvi_core-0f.rlib").as_deref(), Some("m"));
    assert_eq!(named("rustc --extern m=libdvi_core-0f.rlib --extern dvi_core=libdvi_core-0f.rlib"), None);
    assert_eq!(named("rustc --extern m=libdvi_core_more-0f.rlib --crate-name dvi_core -L deps"), None);
}
