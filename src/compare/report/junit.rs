//! JUnit's XML, which systems that run tests read: a case each.

use super::case::Case;
use super::cases::Cases;
use super::escape::escaped;
use crate::compare::judgement::Ruling;

impl Cases {
    /// The report as JUnit's XML. `files` are of each case the paths of files that belong to it: GitLab and Jenkins show those that a line
    /// `[[ATTACHMENT|path]]` names.
    ///
    /// # Panics
    /// When there are files of other than each case.
    pub fn junit(&self, files: &[Vec<String>]) -> String {
        assert_eq!(files.len(), self.cases.len(), "files of each case");
        let failed = self.cases.iter().filter(|case| case.ruling == Ruling::Fail).count();
        let suite = self.set.as_ref().map_or_else(|| self.cases[0].expected.clone(), |(set, _)| set.clone());
        let (suite, tests) = (escaped(&suite), self.cases.len());
        let counts = format!("tests=\"{tests}\" failures=\"{failed}\" errors=\"0\" skipped=\"0\"");
        let cases: String = self.cases.iter().zip(files).map(|(case, files)| element(case, files)).collect();
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"drapery compare\" {counts}>\n  <testsuite name=\"{suite}\" {counts}>\n\
             {cases}  </testsuite>\n</testsuites>\n"
        )
    }
}

fn element(case: &Case, files: &[String]) -> String {
    let (name, text) = (escaped(&case.name), escaped(&case.text()));
    let failure = case.failure.as_ref().map_or(String::new(), |failure| {
        let (kind, message) = (escaped(&failure.name), escaped(&failure.text));
        format!("      <failure type=\"{kind}\" message=\"{message}\">{text}</failure>\n")
    });
    let attached: String = files.iter().map(|path| format!("[[ATTACHMENT|{}]]\n", escaped(path))).collect();
    format!(
        "    <testcase classname=\"drapery.compare\" name=\"{name}\">\n{failure}      <system-out>{text}\n{attached}</system-out>\n    </testcase>\n"
    )
}
