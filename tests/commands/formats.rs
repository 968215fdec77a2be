//! The tables of keys.

use planar_capture::format::{Default, Key, Shape, TableFormat, With};
use planar_capture::{layout, scenario};

/// Every table of a file, each once.
fn tables(root: &'static TableFormat) -> Vec<&'static TableFormat> {
    let inner = root.keys.iter().filter_map(|key| match key.shape {
        Shape::Table(table) | Shape::Tables(table) => Some(table),
        _ => None,
    });
    let mut all = vec![root];
    for table in inner.flat_map(tables) {
        if !all.iter().any(|known| std::ptr::eq(*known, table)) {
            all.push(table);
        }
    }
    all
}

fn choices(key: &Key) -> Vec<&'static str> {
    match &key.shape {
        Shape::Choice(of) | Shape::OneOrList(Shape::Choice(of), _) => of().iter().map(|choice| choice.name).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn tables_of_keys_agree_with_themselves() {
    for table in [&layout::FORMAT, &scenario::FORMAT].into_iter().flat_map(tables) {
        let names = table.names();
        assert!(table.one_of.iter().all(|name| names.contains(name)), "{}", table.doc);
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name), "entries of `{name}` are not beside each other");
        }
        for key in table.keys {
            match key.with {
                Some(With::Choice(selector, with)) => {
                    let known = choices(table.key(selector).expect(selector));
                    assert!(with.iter().all(|choice| known.contains(choice)), "{}: {with:?} of {known:?}", key.name);
                }
                Some(With::Key(others)) => assert!(others.iter().all(|other| names.contains(other)), "{}", key.name),
                None => assert_eq!(table.variants(key.name).count(), 1, "{} without a choice", key.name),
            }
            match key.default {
                Default::Choice(choice) => assert!(choices(key).contains(&choice), "{}", key.name),
                Default::Number(_) => assert!(key.shape.rule().is_some(), "{}", key.name),
                _ => {}
            }
            let doc = key.doc;
            assert!(!doc.is_empty() && !doc.ends_with('.') && !doc.contains('\n'), "{}: {doc}", key.name);
        }
    }
}
