// How report.html looks.
#pragma once

#include <string_view>

namespace fanbeam::measure {

inline constexpr std::string_view kPageStyle = R"(
:root { color-scheme: light dark; --ink: #1c2128; --soft: #57606a; --line: #d0d7de; --back: #ffffff;
  --panel: #f6f8fa; --good: #1a7f37; --bad: #b3261e; --new: #8250df; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6edf3; --soft: #9198a1; --line: #3d444d;
  --back: #0d1117; --panel: #151b23; --good: #3fb950; --bad: #ff7b72; --new: #bc8cff; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 78rem; padding: 1.5rem; color: var(--ink); background: var(--back);
  font: 15px/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; margin: 0; }
h2 { font-size: 1.2rem; margin: 0 0 .4rem; }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; font-family: ui-monospace, monospace; }
a { color: inherit; }
p { margin: .3rem 0; }
.soft { color: var(--soft); }
.badge { display: inline-block; padding: 0 .6em; border: 1px solid; border-radius: 1em;
  font-size: .8rem; font-weight: 600; white-space: nowrap; }
.passed { color: var(--good); } .differs, .failed { color: var(--bad); }
.unapproved { color: var(--new); }
table { border-collapse: collapse; margin: .6rem 0; font-size: .9rem; }
th, td { text-align: left; vertical-align: top; padding: .25rem .8rem .25rem 0;
  border-bottom: 1px solid var(--line); }
th { font-weight: 600; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
table.cases { width: 100%; }
section { margin: 2rem 0; padding: 1rem 1.2rem; border: 1px solid var(--line); border-radius: 8px;
  background: var(--panel); }
blockquote { margin: .3rem 0; padding-left: .8rem; border-left: 3px solid var(--line);
  white-space: pre-line; }
.views { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; }
figure { margin: 0; }
figcaption { font-size: .85rem; color: var(--soft); }
.view img { height: 480px; min-width: 300px; max-width: 100%; image-rendering: pixelated;
  background: #000; display: block; }
.map img { max-width: 100%; display: block; }
.beyond { color: var(--bad); font-weight: 600; }
code { font-family: ui-monospace, monospace; font-size: .9em; }
)";

}  // namespace fanbeam::measure
