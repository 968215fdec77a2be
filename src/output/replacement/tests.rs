use super::*;
use std::collections::BTreeMap;
use tempfile::TempDir;

type Content = BTreeMap<String, String>;

/// Content of a folder with a folder in it, without temporary ones.
fn content(folder: &Path) -> Content {
    let mut all = Content::new();
    for name in names(folder).expect("a folder") {
        let (path, name) = (folder.join(&name), name.into_string().expect("UTF-8"));
        if path.is_dir() {
            all.extend(content(&path).into_iter().map(|(inner, text)| (format!("{name}/{inner}"), text)));
        } else {
            all.insert(name, fs::read_to_string(path).expect("a file"));
        }
    }
    all
}

fn write(folder: &Path, content: &Content) {
    for (name, text) in content {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("folders");
        fs::write(path, text).expect("written");
    }
}

fn some(names: &[&str], text: &str) -> Content {
    names.iter().map(|name| ((*name).to_owned(), text.to_owned())).collect()
}

/// A folder of results, its old and its new content.
struct Fixture {
    folder: TempDir,
    temporary: PathBuf,
    contents: [Content; 2],
}

impl Fixture {
    fn new(old: &[&str]) -> Self {
        let folder = TempDir::new().expect("a folder");
        let temporary = folder.path().join(format!(".planar-capture-{}", "a".repeat(24)));
        let new = some(&["b.csv", "c.csv", "figures/x.svg", "summary.json"], "new");
        let contents = [some(old, "old"), new];
        write(folder.path(), &contents[0]);
        write(&temporary.join(NEW), &contents[1]);
        Self { folder, temporary, contents }
    }

    /// Killed after so many operations, if it has more: none works then.
    fn replace(&self, operations: usize) -> bool {
        replace(self.folder.path(), &self.temporary, SUMMARY, &mut some_of(operations)).is_ok()
    }

    fn settle(&self, operations: usize) -> bool {
        settle(self.folder.path(), &self.temporary, &mut some_of(operations)).is_ok()
    }

    fn content(&self) -> Content {
        content(self.folder.path())
    }

    /// A folder that seems complete is.
    fn check(&self, when: &str) {
        let found = self.content();
        assert!(!found.contains_key(SUMMARY) || self.contents.contains(&found), "{when}: {found:?}");
    }
}

/// Renames so often, then never again.
fn some_of(mut operations: usize) -> impl FnMut(&Path, &Path) -> io::Result<()> {
    move |from, to| {
        operations = operations.checked_sub(1).ok_or(io::ErrorKind::Interrupted)?;
        fs::rename(from, to)
    }
}

const OWN: &[&str] = &["a.csv", "b.csv", "figures/x.svg", "figures/y.svg", "summary.json"];

#[test]
fn a_replacement_killed_at_any_operation_is_settled_by_the_next() {
    // with --force, files that no run has written
    for old in [OWN, &["mine", "b.csv"], &[]] {
        let away = names(Fixture::new(old).folder.path()).expect("a folder").len();
        for first in 0.. {
            let when = format!("killed after {first}");
            let killed = Fixture::new(old);
            let whole = killed.replace(first);
            killed.check(&when);
            // the old content until all of it is away
            let expected = &killed.contents[usize::from(first > away)];
            for second in 0.. {
                let when = format!("{when}, settling after {second}");
                let again = Fixture::new(old);
                again.replace(first);
                let settled = again.settle(second);
                again.check(&when);
                assert!(again.settle(usize::MAX) && is_settled(&again.temporary), "{when}");
                assert_eq!(&again.content(), expected, "{when}");
                if settled {
                    break;
                }
            }
            if whole {
                assert_eq!(killed.content(), killed.contents[1]);
                break;
            }
        }
    }
}

/// Removal may be interrupted anywhere.
#[test]
fn what_is_left_of_a_removal_moves_nothing() {
    for operations in 0..12 {
        for removed in [NEW, OLD, REPLACED] {
            let fixture = Fixture::new(OWN);
            fixture.replace(operations);
            assert!(fixture.settle(usize::MAX));
            let before = fixture.content();
            let _ = fs::remove_dir_all(fixture.temporary.join(removed));
            let _ = fs::remove_file(fixture.temporary.join(NEW).join("b.csv"));
            let _ = fs::remove_file(fixture.temporary.join(REPLACED).join("b.csv"));
            assert!(fixture.settle(usize::MAX) && is_settled(&fixture.temporary), "{operations}, {removed}");
            assert_eq!(fixture.content(), before, "{operations}, {removed}");
        }
    }
}

#[test]
fn an_operation_that_fails_is_followed_by_the_inverse_of_those_before() {
    for failing in 0..9 {
        let fixture = Fixture::new(OWN);
        let mut count = 0;
        let mut rename = |from: &Path, to: &Path| {
            count += 1;
            if count == failing + 1 { Err(io::ErrorKind::StorageFull.into()) } else { fs::rename(from, to) }
        };
        let error = replace(fixture.folder.path(), &fixture.temporary, SUMMARY, &mut rename).expect_err("a full disk");
        assert_eq!(error.source.kind(), io::ErrorKind::StorageFull);
        assert_eq!(fixture.content(), fixture.contents[0]);
        assert_eq!(content(&fixture.temporary.join(NEW)), fixture.contents[1]);
        assert!(is_settled(&fixture.temporary));
    }
}

/// Nothing is overwritten, and what could not be moved stays in the temporary folder.
#[test]
fn what_somebody_has_put_there_since_stays() {
    let fixture = Fixture::new(OWN);
    fixture.replace(2);
    let mine = fixture.folder.path().join(SUMMARY);
    fs::write(&mine, "mine").expect("written");
    assert!(!fixture.settle(usize::MAX) && !is_settled(&fixture.temporary));
    assert_eq!(fs::read_to_string(mine).expect("a file"), "mine");
    assert_eq!(fs::read_to_string(fixture.temporary.join(OLD).join(SUMMARY)).expect("a file"), "old");
}
