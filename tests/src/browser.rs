//! What pages do in a browser: the tests of several packages have this file in common.

use std::error::Error;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A name under which there is a browser to be run without a window.
fn browser() -> Option<&'static str> {
    let starts = |name: &&str| {
        let version =
            Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        version.is_ok_and(|status| status.success())
    };
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(starts)
}

/// Shows a page in a frame, which can be narrower than a window, and what the page tells of itself.
const FRAME: &str =
    "<!DOCTYPE html><meta name='color-scheme' content='light dark'><pre id='found'></pre><script>
addEventListener('message', ({ data }) => { document.getElementById('found').textContent = data; });
</script>";

/// What a page becomes in some seconds in a theme.
fn displayed(browser: &str, file: &Path, theme: usize) -> Result<String, Box<dyn Error>> {
    let profile = file.with_extension("profile");
    let output = file.with_extension("out");
    for _ in 0..3 {
        let mut child = Command::new(browser)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .args(["--virtual-time-budget=20000", "--dump-dom"])
            .arg(format!("--user-data-dir={}", profile.display()))
            .arg("--window-size=1300,900")
            .arg(format!("--blink-settings=preferredColorScheme={theme}"))
            .arg(format!("file://{}", file.display()))
            .stdout(File::create(&output)?)
            .stderr(Stdio::null())
            .spawn()?;
        let begun = Instant::now();
        let mut ended = child.try_wait()?;
        while ended.is_none() && begun.elapsed() < Duration::from_secs(100) {
            std::thread::sleep(Duration::from_millis(50));
            ended = child.try_wait()?;
        }
        if ended.is_none() {
            child.kill()?;
            child.wait()?;
        }
        // It need not be there.
        let _ = fs::remove_dir_all(&profile);
        let text = fs::read_to_string(&output)?;
        // A browser without a screen may crash before it has loaded the page.
        if ended.is_some_and(|status| status.success()) && text.contains("</html>") {
            return Ok(text);
        }
    }
    Err(format!("{browser} does not show {}", file.display()).into())
}

/// What the script says that is put at the head of a page, which is written to `file`, in a window of a
/// width, dark (0) or light (1); `None` without a browser, and a line that says so.
pub(crate) fn told(
    page: &str,
    script: &str,
    file: &Path,
    width: u32,
    theme: usize,
) -> Result<Option<String>, Box<dyn Error>> {
    let Some(browser) = browser() else {
        writeln!(std::io::stderr(), "NOT CHECKED: there is no Chromium to show {}", file.display())?;
        return Ok(None);
    };
    fs::write(file, page.replacen("<head>", &format!("<head><script>{script}</script>"), 1))?;
    let frame = file.with_extension("frame.html");
    let name = file.file_name().ok_or("it has a name")?.to_string_lossy();
    fs::write(&frame, format!("{FRAME}<iframe src='{name}' width='{width}' height='900'></iframe>"))?;
    let text = displayed(browser, &frame, theme)?;
    let found = text.split_once("<pre id=\"found\">").and_then(|(_, rest)| rest.split_once("</pre>"));
    let (found, _) = found.ok_or("there is a place for what was found")?;
    let window = format!("ok the window is {width} wide, and {}", ["dark", "light"][theme]);
    assert!(found.lines().all(|line| line.starts_with("ok ")), "{}:\n{found}", file.display());
    assert!(found.ends_with(&window), "{}:\n{found}", file.display());
    Ok(Some(found.to_owned()))
}
