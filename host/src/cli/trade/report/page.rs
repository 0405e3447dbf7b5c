//! The page: its parts, which lie beside this file, and the data in one text.

/// The parts in their order; scripts see each other's names.
const STYLE: &str = include_str!("page/style.css");
const BODY: &str = include_str!("page/body.html");
const SCRIPTS: [&str; 6] = [
    include_str!("page/data.js"),
    include_str!("page/plot.js"),
    include_str!("page/table.js"),
    include_str!("page/axes.js"),
    include_str!("page/images.js"),
    include_str!("page/main.js"),
];

/// Nothing from elsewhere, whatever names in the data say.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

pub(super) fn html(json: &str) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>lightbvh: speed against accuracy</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{BODY}\
         <script type=\"application/json\" id=\"data\">{}</script>\n<script>\n\"use strict\";\n",
        inert(json)
    );
    for script in SCRIPTS {
        page += script;
    }
    page += "</script>\n</body>\n</html>\n";
    page
}

/// JSON that ends no element and opens no comment, whatever its strings hold.
fn inert(json: &str) -> String {
    json.replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_the_data_end_no_element() {
        let name = "a</script><script>alert(1)</script><!--.glb";
        let json = serde_json::json!({ "scene": name }).to_string();
        let page = html(&json);
        assert!(!page.contains("alert(1)</script>"));
        let start = page.find("id=\"data\">").expect("the data") + "id=\"data\">".len();
        let end = start + page[start..].find("</script>").expect("its end");
        let read: serde_json::Value = serde_json::from_str(&page[start..end]).expect("JSON");
        assert_eq!(read["scene"], name);
    }
}
