#include "app/report/FigureDrawing.h"
#include "app/report/NumberText.h"
#include "app/report/Report.h"

namespace tacto {
namespace {

constexpr auto kStyle = R"css(
:root { color-scheme: light dark; --text: @text; --quiet: @quiet; --page: #fff; --rule: @grid; --line: @line;
        --tint: @tint; }
@media (prefers-color-scheme: dark) {
  :root { --text: #e9ecef; --quiet: #a9b2bc; --page: #14171b; --rule: #272d34; --line: #363d46; --tint: #23282e; }
}
body { margin: 0; background: var(--page); color: var(--text);
       font: 15px/1.5 "Noto Sans", "Noto Sans Math", "Open Sans", "Segoe UI", "DejaVu Sans", system-ui, sans-serif;
       font-variant-numeric: tabular-nums; }
main { max-width: 860px; margin: 0 auto; padding: 32px 20px 64px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 4px; }
h2 { font-size: 20px; margin: 40px 0 12px; }
p { margin: 0 0 12px; } .quiet { color: var(--quiet); }
.verdict { margin: 20px 0; background: var(--tint); }
.verdict p { margin: 0; padding: 10px 20px; font-size: 24px; line-height: 1.3; font-weight: bold;
             -webkit-print-color-adjust: exact; print-color-adjust: exact; }
.verdict .symbol { display: inline-block; min-width: 36px; }
.verdict ul { margin: 0; padding: 12px 20px 12px 38px; }
figure { margin: 24px 0; }
figure svg { display: block; width: 100%; height: auto; background: #fff; border-radius: 4px; }
figcaption { margin-top: 8px; } figcaption span { display: block; color: var(--quiet); font-size: 13px; }
.scroll { overflow-x: auto; margin: 16px 0 24px; }
table { border-collapse: collapse; font-size: 13.5px; }
caption { text-align: left; font-weight: bold; margin-bottom: 6px; font-size: 15px; white-space: nowrap; }
th, td { padding: 5px 12px 5px 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--rule); }
thead th { color: var(--quiet); font-size: 12px; font-weight: normal; vertical-align: bottom;
           border-bottom: 1px solid var(--line); }
tbody tr:last-child > * { border-bottom-color: var(--line); }
.matrix { font-size: 13px; } .matrix th[scope=row] { font-weight: normal; min-width: 150px; }
.matrix td, .matrix th { padding: 4px 8px; } .matrix small { display: block; color: var(--quiet); font-size: 11px; }
.close { background: @amberCell; color: @amberText; font-weight: bold; }
.broken { background: @fail; color: @onFail; font-weight: bold; }
.close, .broken, .open { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
.open { background: repeating-linear-gradient(135deg, transparent 0 5px, var(--rule) 5px 6px); }
.matrix .close small, .matrix .broken small { color: inherit; font-weight: normal; }
.number { text-align: right; white-space: nowrap; }
dl { display: grid; grid-template-columns: minmax(120px, 200px) 1fr; gap: 4px 16px; margin: 0 0 16px; }
dt { color: var(--quiet); } dd { margin: 0; overflow-wrap: anywhere; }
.blank { min-height: 1.9em; border-bottom: 1px solid var(--quiet); }
code, pre { font-family: "DejaVu Sans Mono", ui-monospace, monospace; font-size: 13px; }
pre { background: var(--tint); padding: 12px 14px; border-radius: 4px; white-space: pre-wrap; overflow-wrap: anywhere; }
.simulated { color: var(--quiet); text-transform: uppercase; letter-spacing: .08em; font-size: 13px; }
.damaged { position: sticky; top: 0; padding: 6px 10px; background: @fault; color: #fff; font-weight: bold; }
@media print { .damaged { position: fixed; left: 0; right: 0; } }
.signatures { width: 100%; } .signatures td, .signatures th[scope=row] { height: 44px; vertical-align: bottom; }
footer { border-top: 1px solid var(--rule); margin-top: 40px; padding-top: 12px; font-size: 13px; color: var(--quiet); }
@media print {
  :root { --text: @text; --quiet: @quiet; --page: #fff; --rule: @grid; --line: @line; --tint: @tint; }
  @page { size: A4; margin: 18mm; }
  main { max-width: none; padding: 0; } body { font-size: 10pt; }
  figure, .verdict, tr, pre { break-inside: avoid; } h2, caption { break-after: avoid; } .scroll { overflow: visible; }
}
)css";

QString pageStyle() {
    QString style = QString::fromUtf8(kStyle);
    const auto fail = verdictMark("fail");
    // If two names begin alike, the longer one must come first.
    for (const auto& [role, colour] : {std::pair("@amberCell", ink::kAmberCell),
                                       {"@amberText", ink::kAmberText},
                                       {"@onFail", fail.ink},
                                       {"@fail", fail.fill},
                                       {"@fault", ink::kFault},
                                       {"@text", ink::kText},
                                       {"@quiet", ink::kQuiet},
                                       {"@grid", ink::kGrid},
                                       {"@line", ink::kLine},
                                       {"@tint", ink::kWindow}})
        style.replace(QLatin1String(role), colour.name());
    return style;
}

class Writer {
public:
    void operator()(const TitleBlock& block) {
        out_ += "<h1>" + escaped(block.title) + "</h1>\n<p class=\"quiet\">" +
                escaped(block.subtitle).replace('\n', "<br/>") + "</p>\n";
    }

    void operator()(const VerdictBlock& block) {
        out_ += QString("<section class=\"verdict\"><p style=\"background: %1; color: %2\">")
                    .arg(block.mark.fill.name(), block.mark.ink.name()) +
                "<span class=\"symbol\" aria-hidden=\"true\">" + escaped(block.mark.shape) + "</span><strong>" +
                escaped(block.word) + "</strong></p>\n<ul>";
        for (const auto& reason : block.reasons) out_ += "<li>" + escaped(reason) + "</li>";
        out_ += "</ul></section>\n";
    }

    void operator()(const HeadingBlock& block) { out_ += "<h2>" + escaped(block.text) + "</h2>\n"; }

    void operator()(const ParagraphBlock& block) {
        out_ += (block.quiet ? "<p class=\"quiet\">" : "<p>") + escaped(block.text).replace('\n', "<br/>") + "</p>\n";
    }

    void operator()(const FactsBlock& block) {
        out_ += "<dl>\n";
        for (const auto& fact : block.facts) {
            const QString value = escaped(fact.value);
            const QString shown = QString(value).replace('\n', "<br/>");
            if (fact.isOpen) {
                out_ += "<dt>" + escaped(fact.name) + "</dt><dd class=\"blank\"></dd>\n";
                continue;
            }
            out_ += "<dt>" + escaped(fact.name) + "</dt><dd>" + (fact.isHash ? "<code>" + value + "</code>" : shown) +
                    "</dd>\n";
        }
        out_ += "</dl>\n";
    }

    void operator()(const TableBlock& block) {
        out_ += "<div class=\"scroll\"><table><caption>" + escaped(block.caption) + "</caption>\n<thead><tr>";
        for (const auto& column : block.columns) {
            out_ += "<th scope=\"col\"" + classOf(column) + ">" + escaped(column.title) + "</th>";
        }
        out_ += "</tr></thead>\n<tbody>\n";
        for (const auto& row : block.rows) {
            out_ += "<tr>";
            for (std::size_t i = 0; i < block.columns.size(); ++i) {
                out_ += "<td" + classOf(block.columns[i]) + ">" + escaped(row.value(qsizetype(i))) + "</td>";
            }
            out_ += "</tr>\n";
        }
        out_ += "</tbody></table></div>\n";
    }

    void operator()(const MatrixBlock& block) {
        out_ += "<div class=\"scroll\"><table class=\"matrix\"><caption>" + escaped(block.caption) +
                "</caption>\n<thead><tr><th></th>";
        for (const auto& column : block.columns)
            out_ += "<th scope=\"col\" class=\"number\">" + escaped(column) + "</th>";
        out_ += "</tr></thead>\n<tbody>\n";
        for (const auto& row : block.rows) {
            out_ += "<tr><th scope=\"row\">" + escaped(row.title) + small(row.note) + "</th>";
            for (const auto& cell : row.cells)
                out_ += QString("<td class=\"number %1\">").arg(stateOf(cell.state)) + escaped(cell.main) +
                        small(cell.detail) + "</td>";
            out_ += "</tr>\n";
        }
        out_ += "</tbody></table>";
        if (!block.legend.isEmpty()) out_ += "<p class=\"quiet\">" + escaped(block.legend) + "</p>";
        out_ += "</div>\n";
    }

    void operator()(const FigureBlock& block) {
        out_ += "<figure>\n" + QString::fromUtf8(sheetSvg(*block.sheet, block.caption)) + "\n<figcaption><strong>" +
                escaped(block.caption) + "</strong>";
        if (!block.legend.isEmpty()) out_ += "<span>" + escaped(block.legend) + "</span>";
        out_ += "</figcaption>\n</figure>\n";
    }

    void operator()(const SignaturesBlock& block) {
        out_ += "<table class=\"signatures\"><thead><tr><th scope=\"col\"></th>";
        for (const auto& column : block.columns) out_ += "<th scope=\"col\">" + escaped(column) + "</th>";
        out_ += "</tr></thead>\n<tbody>\n";
        for (qsizetype r = 0; r < block.roles.size(); ++r) {
            out_ +=
                "<tr><th scope=\"row\">" + escaped(block.roles[r]) + "</th><td>" +
                escaped(block.given.value(r).isEmpty() && !block.open ? QString("not recorded")
                                                                      : block.given.value(r)) +
                "</td>" +
                (block.second.isEmpty() || r > 0 ? QString("<td></td>") : "<td>" + escaped(block.second) + "</td>") +
                QString("<td></td>").repeated(block.columns.size() - 2) + "</tr>\n";
        }
        out_ += "</tbody></table>\n";
    }

    void operator()(const CodeBlock& block) { out_ += "<pre>" + escaped(block.lines.join('\n')) + "</pre>\n"; }

    static QString escaped(const QString& text) { return visible(text).toHtmlEscaped(); }

    QString take() { return std::move(out_); }

private:
    static QString small(const QString& text) {
        return text.isEmpty() ? QString() : "<small>" + escaped(text).replace('\n', "<br/>") + "</small>";
    }
    static QString stateOf(MatrixBlock::State state) {
        switch (state) {
            case MatrixBlock::State::Close:
                return "close";
            case MatrixBlock::State::Broken:
                return "broken";
            case MatrixBlock::State::Open:
                return "open";
            case MatrixBlock::State::Plain:
            case MatrixBlock::State::Empty:
                break;
        }
        return {};
    }
    static QString classOf(const TableBlock::Column& column) { return column.numeric ? " class=\"number\"" : ""; }
    QString out_;
};

}  // namespace

QByteArray reportHtml(const ReportContent& content) {
    Writer writer;
    for (const auto& block : content.blocks) std::visit(writer, block);
    QString html =
        "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
        "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<title>" +
        Writer::escaped(content.documentTitle) + "</title>\n<style>" + pageStyle() +
        "</style>\n</head>\n<body>\n<main>\n";
    // On a screen the header appears once and stays in sight; on paper it is repeated on each page.
    html += QString("<p class=\"simulated%1\">").arg(content.alarming ? " damaged" : "") +
            Writer::escaped(content.header) + "</p>\n" + writer.take();
    html += "<footer>" + Writer::escaped(content.footer) + "</footer>\n</main>\n</body>\n</html>\n";
    return html.toUtf8();
}

}  // namespace tacto
