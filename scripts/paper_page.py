"""The page of scripts/paper: one HTML file that holds its pictures and asks nothing of a network."""

import base64
import html

STYLE = """
:root { color-scheme: light dark; --text: #222; --soft: #666; --line: #d8d8d8; --back: #fff; --code: #f3f3f1; }
@media (prefers-color-scheme: dark) { :root { --text: #e6e6e6; --soft: #a0a0a0; --line: #444; --back: #17181a; --code: #232528; } }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--text); background: var(--back); max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem } h2 { font-size: 1.25rem; margin: 2.6rem 0 .3rem; border-top: 1px solid var(--line); padding-top: 1rem }
p { margin: .5rem 0 } .soft { color: var(--soft) } .warn { color: #b04a00 }
.pictures { display: flex; flex-wrap: wrap; gap: 8px; margin: .8rem 0 }
.pictures figure { margin: 0; flex: 1 1 18rem } .pictures img { width: 100%; display: block; border-radius: 3px }
.pictures.whole figure { flex-basis: 100% } figcaption { font-size: .85rem; color: var(--soft) }
.drawing { background: #fff; border-radius: 3px; margin: .8rem 0 } .drawing svg { width: 100%; max-height: 36rem; display: block }
pre { font: 12.5px/1.45 ui-monospace, monospace; background: var(--code); padding: .5rem .7rem; margin: .3rem 0; white-space: pre-wrap; overflow-wrap: anywhere; border-radius: 3px }
table { border-collapse: collapse; margin: .8rem 0; font-variant-numeric: tabular-nums }
th, td { border-bottom: 1px solid var(--line); padding: .3rem .8rem; text-align: right } th:first-child, td:first-child { text-align: left }
thead th { font-weight: 600 } nav a { margin-right: .9rem; white-space: nowrap } a { color: #2b6cb0 }
"""


class Picture:
    """A picture of a section: PNG bytes and its words, or the text of an SVG."""

    def __init__(self, words, png=None, svg=None):
        self.words, self.png, self.svg = words, png, svg


class Section:
    """One figure or table. `paper`, `here`: HTML paragraphs; `commands`: as a shell would take them."""

    def __init__(self, name, title, paper, here, commands, pictures=(), table="", whole=False):
        self.name, self.title, self.paper, self.here, self.commands = name, title, paper, here, commands
        self.pictures, self.table, self.whole = pictures, table, whole


def picture_html(picture):
    words = html.escape(picture.words)
    if picture.svg:
        return f'<div class="drawing">{picture.svg}</div>'
    data = base64.b64encode(picture.png).decode("ascii")
    return f'<figure><img alt="{words}" src="data:image/png;base64,{data}"><figcaption>{words}</figcaption></figure>'


def table_html(columns, rows):
    """Cells are HTML."""
    head = "".join(f"<th>{cell}</th>" for cell in columns)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>\n" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table>"


def section_html(section):
    drawings = "".join(picture_html(picture) for picture in section.pictures if picture.svg)
    photos = "\n".join(picture_html(picture) for picture in section.pictures if picture.png)
    parts = [f'<h2 id="{section.name}">{html.escape(section.title)}</h2>',
             f'<p class="soft">{section.paper}</p>' if section.paper else "", drawings,
             f'<div class="pictures{" whole" if section.whole else ""}">\n{photos}\n</div>' if photos else "",
             section.table, f"<p>{section.here}</p>" if section.here else "",
             *(f"<pre>{html.escape(command)}</pre>" for command in section.commands)]
    return "\n".join(part for part in parts if part)


def page_html(title, lead, sections):
    """`lead`: HTML paragraphs."""
    links = "".join(f'<a href="#{section.name}">{html.escape(section.title.split(":")[0])}</a>' for section in sections)
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{html.escape(title)}</title><style>{STYLE}</style></head><body>
<h1>{html.escape(title)}</h1>
{lead}
<nav>{links}</nav>
""" + "\n".join(section_html(section) for section in sections) + "\n</body></html>\n"
