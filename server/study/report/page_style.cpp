#include "server/study/report/page_style.h"

namespace herr {

const char* const kPageStyle = R"(
:root { color-scheme: light }
* { box-sizing: border-box }
body { font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; background: #fff; max-width: 76rem; margin: 1.5rem auto;
  padding: 0 1rem }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0 0 .5rem }
h2 { font-size: 1.25rem; margin: 2.2rem 0 .6rem; border-bottom: 2px solid #1a1a1a }
h3 { font-size: 1.05rem; margin: 1.4rem 0 .3rem }
h1, h2, h3, p, li, dd, dt, figcaption { overflow-wrap: anywhere }
p { margin: .4rem 0; max-width: 60rem }
code { font: .88em/1.4 ui-monospace, monospace; background: #f1f1f1; padding: .1em .3em; overflow-wrap: anywhere }
a { color: #00518a }
ul.lines { padding-left: 1.2rem; margin: .4rem 0; max-width: 60rem }
ul.aims { list-style: none; padding: 0; margin: 0 }
ul.aims li { border-left: .4rem solid #00684f; background: #eef7f3; padding: .4rem .8rem; margin: .4rem 0 }
ul.aims li.missed { border-color: #b02a00; background: #fdf0ec }
dl.facts { display: grid; grid-template-columns: max-content 1fr; gap: .1rem 1rem; margin: .6rem 0 }
dl.facts dt, dl.metrics dt { font-weight: 600 }
dl.facts dd, dl.metrics dd { margin: 0; min-width: 0 }
dl.metrics dt { margin-top: .6rem }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 22rem), 1fr)); gap: 1.2rem }
figure { margin: .6rem 0; min-width: 0; break-inside: avoid; page-break-inside: avoid }
figure.main { max-width: 42rem }
figcaption, .note { font-size: .9rem; color: #444 }
figcaption p { margin: .15rem 0 }
figcaption b { color: #1a1a1a }
svg.plot { display: block; width: 100%; height: auto; max-width: 42rem }
.grid svg.plot { max-width: 30rem }
.legend { display: flex; flex-wrap: wrap; gap: .1rem 1rem; list-style: none; padding: 0; margin: .2rem 0;
  font-size: .9rem }
.legend li { display: flex; align-items: center; gap: .3rem; min-width: 0 }
.legend svg { flex: none }
img { display: block; max-width: 100%; height: auto }
.pixels img { image-rendering: pixelated }
.wide { overflow-x: auto; margin: .5rem 0 }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums }
caption { text-align: left; font-weight: 600; font-size: 1rem; padding: .3rem 0 }
th, td { padding: .2rem .7rem .2rem 0; text-align: right; vertical-align: top; white-space: nowrap }
th { border-bottom: 1px solid #1a1a1a; vertical-align: bottom }
td { border-bottom: 1px solid #ddd }
.w { text-align: left }
td.prose { white-space: normal; min-width: 13rem; max-width: 26rem }
code span { display: inline-block; max-width: 100% }
@media (max-width: 40rem) {
  body { padding: 0 .75rem; margin: .75rem auto }
  h1 { font-size: 1.35rem }
  dl.facts { grid-template-columns: 1fr; gap: 0 }
  dl.facts dd { margin-bottom: .4rem }
}
@page { margin: 14mm }
@media print {
  body { font-size: 10pt; color: #000; max-width: none; margin: 0; padding: 0 }
  a { color: #000; text-decoration: none }
  h2, h3, caption { break-after: avoid; page-break-after: avoid }
  .wide { overflow: visible }
  table { font-size: 6.5pt; width: 100% }
  caption { font-size: 9pt }
  th, td { padding-right: .35rem }
  th { white-space: normal }
  td.prose { white-space: normal; overflow-wrap: anywhere }
  thead { break-after: avoid; page-break-after: avoid }
  td.prose { min-width: 0; max-width: none }
  tr, li, dd { break-inside: avoid; page-break-inside: avoid }
  figure.main { max-width: 125mm }
  .grid { display: block }
  .grid figure { display: inline-block; width: 32%; vertical-align: top; margin: 0 .5% 4mm 0 }
  ul.aims li { background: #fff }
  code { background: #fff; padding: 0 }
  figcaption, .note, .legend { color: #000; font-size: 7.5pt }
}
)";

}  // namespace herr
