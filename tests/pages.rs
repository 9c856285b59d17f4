//! What the project's pages list.

/// The items of the lists of a page, each on one line and without its mark.
pub fn list_items(page: &str) -> Vec<String> {
    let mut items: Vec<String> = Vec::new();
    let mut inside = false;
    for line in page.lines() {
        if let Some(begin) = line.strip_prefix("* ") {
            items.push(begin.to_owned());
            inside = true;
        } else if let (true, Some(more)) = (inside, line.strip_prefix("  ")) {
            let item = items.last_mut().expect("an item is open");
            item.push(' ');
            item.push_str(more.trim_start());
        } else {
            inside = false;
        }
    }
    items
}
