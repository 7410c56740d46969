//! One file as code: the paths that stand in it, written out in full.

use super::tokens;
use proc_macro2::{Ident, TokenStream};
use std::collections::{BTreeMap, BTreeSet};
use syn::visit::{self, Visit};
use syn::{Attribute, ImplItem, Item, Meta, TraitItem, UseTree};

/// The code of one file.
#[derive(Debug, Default)]
pub struct Code {
    /// The paths of at least two names, and the macros that are called (as `name!`).
    pub mentions: Vec<Mention>,
    /// What `use` brings into a module: (module, name) to the path in full; a glob has the name `*` and a number.
    pub bindings: BTreeMap<(Vec<String>, String), Vec<String>>,
    /// Items that are defined here, each by its module and its name.
    pub items: BTreeSet<(Vec<String>, String)>,
    /// Modules with a file of their own: the path, and whether only tests have them.
    pub modules: Vec<(Vec<String>, bool)>,
    /// Modules whose text stands here, the file's own first.
    pub inline: Vec<Vec<String>>,
    /// Public functions and methods that are defined here: name and line.
    pub functions: Vec<(String, usize)>,
    /// How often each name stands here, definitions and `use` left out.
    pub names: BTreeMap<String, i64>,
}

/// A path in a file's code.
#[derive(Debug)]
pub struct Mention {
    /// From the crate's name on: `drapery::..` whether it was `crate::..`, `super::..` or a name that `use` had renamed;
    /// a path that leads out of the crate begins with the other crate's name.
    pub path: Vec<String>,
    /// The line in the file, from 1.
    pub line: usize,
    /// Stands in a `pub use` (of any width) whose name the file does not need itself: a door, not a dependence.
    pub is_only_passed_on: bool,
}

impl Code {
    /// Reads a file's text as the module of this path (its crate's name first).
    pub fn of(module: &[String], text: &str) -> syn::Result<Self> {
        let file = syn::parse_file(text)?;
        let mut reader = Reader { here: module.to_vec(), ..Reader::default() };
        reader.code.inline.push(module.to_vec());
        if !is_for_tests(&file.attrs) {
            reader.visit_file(&file);
        }
        Ok(reader.finish())
    }
}

/// A path as it is written.
struct Written {
    /// The module in which it stands.
    here: Vec<String>,
    names: Vec<String>,
    line: usize,
    /// The name that a `pub use` gives it.
    passed_on_as: Option<String>,
}

/// Walks through a file and writes down what it finds.
#[derive(Default)]
struct Reader {
    here: Vec<String>,
    code: Code,
    written: Vec<Written>,
    /// The `use` declarations: as in [`Code::bindings`], paths as they are written.
    bound: BTreeMap<(Vec<String>, String), Vec<String>>,
    /// The first names of all paths outside of `use`, by module.
    needed: BTreeSet<(Vec<String>, String)>,
}

impl Reader {
    /// Writes all paths out in full, once all names are known.
    fn finish(mut self) -> Code {
        let full = |here: &[String], names: &[String]| self.full(here, names, 0);
        let bindings = self.bound.iter().map(|(key, names)| (key.clone(), full(&key.0, names))).collect();
        let mention = |written: &Written| {
            let passed_on = written.passed_on_as.as_ref();
            let is_needed = |name: &String| self.needed.contains(&(written.here.clone(), name.clone()));
            Mention {
                path: full(&written.here, &written.names),
                line: written.line,
                is_only_passed_on: passed_on.is_some_and(|name| !is_needed(name)),
            }
        };
        let mentions = self.written.iter().map(mention).collect();
        self.code.bindings = bindings;
        self.code.mentions = mentions;
        self.code
    }

    /// A path from its crate's name on.
    fn full(&self, here: &[String], names: &[String], depth: usize) -> Vec<String> {
        let Some((first, rest)) = names.split_first() else { return here.to_vec() };
        match first.as_str() {
            "crate" => [&here[..1], rest].concat(),
            "self" => self.below(here, rest),
            "super" => self.below(&here[..here.len().saturating_sub(1).max(1)], rest),
            _ => self.by_name(here, names, depth),
        }
    }

    /// A path below a module; each further `super` goes one up.
    fn below(&self, module: &[String], rest: &[String]) -> Vec<String> {
        match rest.split_first() {
            Some((up, rest)) if up == "super" && module.len() > 1 => {
                self.below(&module[..module.len() - 1], rest)
            }
            _ => [module, rest].concat(),
        }
    }

    /// A path that begins with a name: one that `use` has brought, one of this module's, or another crate's.
    fn by_name(&self, here: &[String], names: &[String], depth: usize) -> Vec<String> {
        let key = (here.to_vec(), names[0].clone());
        let child = [here, &names[..1]].concat();
        match self.bound.get(&key) {
            // A name may stand for itself (`use rayon;`), or for another of the same name.
            Some(target) if depth < 8 && target[..] != names[..1] => {
                [self.full(here, target, depth + 1), names[1..].to_vec()].concat()
            }
            _ if self.code.items.contains(&key) || self.is_module(&child) => [here, names].concat(),
            _ => names.to_vec(),
        }
    }

    fn is_module(&self, path: &[String]) -> bool {
        self.code.inline.iter().any(|p| p == path) || self.code.modules.iter().any(|(p, _)| p == path)
    }

    fn write(&mut self, names: Vec<String>, line: usize) {
        self.needed.insert((self.here.clone(), names[0].clone()));
        if names.len() > 1 || names[0].ends_with('!') {
            self.written.push(Written { here: self.here.clone(), names, line, passed_on_as: None });
        }
    }

    fn offer(&mut self, width: &syn::Visibility, signature: &syn::Signature) {
        let name = text_of(&signature.ident);
        if matches!(width, syn::Visibility::Public(_)) {
            self.code.functions.push((name.clone(), line_of(signature.ident.span())));
        }
        // The definition itself is about to be counted.
        *self.code.names.entry(name).or_default() -= 1;
    }

    fn define(&mut self, name: &Ident) {
        self.code.items.insert((self.here.clone(), text_of(name)));
    }

    /// Takes a `use` tree apart.
    fn bring(&mut self, tree: &UseTree, before: &[String], is_public: bool) {
        let with = |name: &Ident| [before, &[text_of(name)]].concat();
        match tree {
            UseTree::Path(path) => self.bring(&path.tree, &with(&path.ident), is_public),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.bring(tree, before, is_public)),
            UseTree::Glob(glob) => {
                let name = format!("*{}", self.bound.len());
                let path = [before, &["*".to_owned()]].concat();
                self.bind(name, path, line_of(glob.star_token.spans[0]), is_public);
            }
            UseTree::Name(name) if name.ident == "self" => {
                let own = before.last().cloned().unwrap_or_default();
                self.bind(own, before.to_vec(), line_of(name.ident.span()), is_public);
            }
            UseTree::Name(name) => {
                self.bind(text_of(&name.ident), with(&name.ident), line_of(name.ident.span()), is_public);
            }
            UseTree::Rename(name) => {
                let path = if name.ident == "self" { before.to_vec() } else { with(&name.ident) };
                self.bind(text_of(&name.rename), path, line_of(name.ident.span()), is_public);
            }
        }
    }

    fn bind(&mut self, name: String, names: Vec<String>, line: usize, is_public: bool) {
        self.bound.insert((self.here.clone(), name.clone()), names.clone());
        let passed_on_as = is_public.then_some(name);
        self.written.push(Written { here: self.here.clone(), names, line, passed_on_as });
    }

    fn enter(&mut self, module: &syn::ItemMod) {
        self.here.push(text_of(&module.ident));
        let is_test = is_for_tests(&module.attrs);
        let is_elsewhere = module.attrs.iter().any(|attribute| attribute.path().is_ident("path"));
        assert!(!is_elsewhere, "`#[path]` hides where {} stands", self.here.join("::"));
        match &module.content {
            None => self.code.modules.push((self.here.clone(), is_test)),
            Some(_) if is_test => {}
            Some(_) => {
                self.code.inline.push(self.here.clone());
                visit::visit_item_mod(self, module);
            }
        }
        self.here.pop();
    }
}

impl<'ast> Visit<'ast> for Reader {
    fn visit_item(&mut self, item: &'ast Item) {
        match item {
            Item::Mod(module) => self.enter(module),
            _ if is_for_tests(attributes(item)) => {}
            _ => {
                if let Some(name) = name_of(item) {
                    self.define(name);
                }
                visit::visit_item(self, item);
            }
        }
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let is_public = !matches!(item.vis, syn::Visibility::Inherited);
        self.bring(&item.tree, &[], is_public);
    }

    fn visit_item_extern_crate(&mut self, item: &'ast syn::ItemExternCrate) {
        let own = if item.ident == "self" { "crate".to_owned() } else { text_of(&item.ident) };
        let name = item.rename.as_ref().map_or_else(|| own.clone(), |(_, name)| text_of(name));
        self.bind(name, vec![own], line_of(item.ident.span()), false);
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.offer(&item.vis, &item.sig);
        visit::visit_item_fn(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.offer(&item.vis, &item.sig);
        visit::visit_impl_item_fn(self, item);
    }

    fn visit_ident(&mut self, name: &'ast Ident) {
        *self.code.names.entry(text_of(name)).or_default() += 1;
    }

    fn visit_impl_item(&mut self, item: &'ast ImplItem) {
        let attributes = match item {
            ImplItem::Const(item) => &item.attrs[..],
            ImplItem::Fn(item) => &item.attrs,
            ImplItem::Type(item) => &item.attrs,
            ImplItem::Macro(item) => &item.attrs,
            _ => &[],
        };
        if !is_for_tests(attributes) {
            visit::visit_impl_item(self, item);
        }
    }

    fn visit_trait_item(&mut self, item: &'ast TraitItem) {
        let attributes = match item {
            TraitItem::Const(item) => &item.attrs[..],
            TraitItem::Fn(item) => &item.attrs,
            TraitItem::Type(item) => &item.attrs,
            TraitItem::Macro(item) => &item.attrs,
            _ => &[],
        };
        if !is_for_tests(attributes) {
            visit::visit_trait_item(self, item);
        }
    }

    fn visit_local(&mut self, local: &'ast syn::Local) {
        if !is_for_tests(&local.attrs) {
            visit::visit_local(self, local);
        }
    }

    fn visit_field(&mut self, field: &'ast syn::Field) {
        if !is_for_tests(&field.attrs) {
            visit::visit_field(self, field);
        }
    }

    fn visit_variant(&mut self, variant: &'ast syn::Variant) {
        if !is_for_tests(&variant.attrs) {
            visit::visit_variant(self, variant);
        }
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        if !is_for_tests(&arm.attrs) {
            visit::visit_arm(self, arm);
        }
    }

    /// `pub(in crate::..)` says who may look, not who is known.
    fn visit_vis_restricted(&mut self, _: &'ast syn::VisRestricted) {}

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        let mut names: Vec<String> = call.path.segments.iter().map(|part| text_of(&part.ident)).collect();
        let line = call.path.segments.first().map_or(0, |part| line_of(part.ident.span()));
        if let Some(last) = names.last_mut() {
            last.push('!');
            self.write(names, line);
        }
        self.visit_token_stream(&call.tokens);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path.segments.iter().map(|part| text_of(&part.ident)).collect();
        let line = path.segments.first().map_or(0, |part| line_of(part.ident.span()));
        self.write(names, line);
        visit::visit_path(self, path);
    }

    /// What macros are given, and the bodies of `macro_rules!`.
    fn visit_token_stream(&mut self, stream: &'ast TokenStream) {
        for (names, line) in tokens::paths(stream.clone()) {
            for name in &names {
                *self.code.names.entry(name.trim_end_matches('!').to_owned()).or_default() += 1;
            }
            self.write(names, line);
        }
    }
}

/// Whether only tests are compiled with these attributes: `cfg(test)`, or an `all(..)` with it.
fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg") => {
            list.parse_args::<Meta>().is_ok_and(|condition| wants_test(&condition))
        }
        _ => false,
    })
}

fn wants_test(condition: &Meta) -> bool {
    let parts = |list: &syn::MetaList| {
        let comma_separated = syn::punctuated::Punctuated::<Meta, syn::Token![,]>::parse_terminated;
        list.parse_args_with(comma_separated).unwrap_or_default()
    };
    match condition {
        Meta::Path(path) => path.is_ident("test"),
        Meta::List(list) if list.path.is_ident("all") => parts(list).iter().any(wants_test),
        Meta::List(list) if list.path.is_ident("any") => {
            let parts = parts(list);
            !parts.is_empty() && parts.iter().all(wants_test)
        }
        _ => false,
    }
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::ForeignMod(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::TraitAlias(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn name_of(item: &Item) -> Option<&Ident> {
    match item {
        Item::Const(item) => Some(&item.ident),
        Item::Enum(item) => Some(&item.ident),
        Item::Fn(item) => Some(&item.sig.ident),
        Item::Macro(item) => item.ident.as_ref(),
        Item::Static(item) => Some(&item.ident),
        Item::Struct(item) => Some(&item.ident),
        Item::Trait(item) => Some(&item.ident),
        Item::TraitAlias(item) => Some(&item.ident),
        Item::Type(item) => Some(&item.ident),
        Item::Union(item) => Some(&item.ident),
        _ => None,
    }
}

/// A name without the `r#` of raw identifiers.
pub fn text_of(name: &Ident) -> String {
    name.to_string().trim_start_matches("r#").to_owned()
}

pub fn line_of(span: proc_macro2::Span) -> usize {
    span.start().line
}
