//! Paths in what a macro is given or made of: text that no grammar describes.

use super::code::{line_of, text_of};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// Each name or path among some tokens, and its line; a macro's call ends with `!`.
pub fn paths(stream: TokenStream) -> Vec<(Vec<String>, usize)> {
    let tokens: Vec<TokenTree> = stream.into_iter().collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        at = match &tokens[at] {
            TokenTree::Ident(_) => path_at(&tokens, at, &[], &mut found),
            TokenTree::Group(group) => {
                if !is_width_of_pub(at.checked_sub(1).map(|before| &tokens[before]), group) {
                    found.extend(paths(group.stream()));
                }
                at + 1
            }
            _ => at + 1,
        }
    }
    found
}

/// Reads the path that begins at a name, with what stood before the braces of a `use`; says where it ends.
fn path_at(
    tokens: &[TokenTree],
    start: usize,
    before: &[String],
    found: &mut Vec<(Vec<String>, usize)>,
) -> usize {
    let mut names = before.to_vec();
    let mut at = start;
    loop {
        match tokens.get(at) {
            Some(TokenTree::Ident(name)) => names.push(text_of(name)),
            Some(token) if is(token, '*') && names.len() > before.len() => names.push("*".into()),
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace && at > start => {
                each_of(group, &names, found);
                return at + 1;
            }
            _ => break,
        }
        at += 1;
        let mut two = tokens.iter().skip(at).take(2);
        if !two.by_ref().all(|token| is(token, ':')) || tokens.len() < at + 2 {
            break;
        }
        at += 2;
    }
    let is_call = tokens.get(at).is_some_and(|token| is(token, '!'))
        && matches!(tokens.get(at + 1), Some(TokenTree::Group(_)));
    if let (true, Some(last)) = (is_call, names.last_mut()) {
        last.push('!');
    }
    found.push((names, line_of(tokens[start].span())));
    at
}

/// The paths in the braces of a `use`.
fn each_of(group: &Group, before: &[String], found: &mut Vec<(Vec<String>, usize)>) {
    let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
    for part in tokens.split(|token| is(token, ',')).filter(|part| !part.is_empty()) {
        path_at(part, 0, before, found);
    }
}

/// Whether a group is what stands behind `pub`.
fn is_width_of_pub(before: Option<&TokenTree>, group: &Group) -> bool {
    let is_pub = matches!(before, Some(TokenTree::Ident(name)) if name == "pub");
    is_pub && group.delimiter() == Delimiter::Parenthesis
}

fn is(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == sign)
}
