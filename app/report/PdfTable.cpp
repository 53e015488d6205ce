#include "app/report/PdfTable.h"

#include "app/report/Fonts.h"

namespace tacto {
namespace {

constexpr double kSize = 11;
constexpr double kPadX = 6;
constexpr double kPadY = 3;
constexpr double kWidestText = 330;  // longer cells wrap

double widthOf(const QString& text, bool bold) {
    double widest = 0;
    for (const auto& line : text.split('\n')) {
        widest = std::max(widest, QFontMetricsF(textFont(kSize, bold)).horizontalAdvance(line));
    }
    return widest;
}

/// The width a column asks for, and the least it can do with (its longest word).
struct Want {
    double ideal = 0;
    double least = 0;
};

Want wantOf(const TableBlock& table, std::size_t column) {
    Want want;
    const auto include = [&](const QString& text, bool bold) {
        want.ideal = std::max(want.ideal, std::min(kWidestText, widthOf(text, bold)));
        // Numbers keep their unit and their uncertainty on one line.
        if (table.columns[column].numeric && !bold) {
            want.least = std::max(want.least, std::min(kWidestText, widthOf(text, bold)));
            return;
        }
        for (const auto& word : text.split(' '))
            want.least = std::max(want.least, std::min(150.0, widthOf(word, bold)));
    };
    include(table.columns[column].title, true);
    for (const auto& row : table.rows) include(row.value(static_cast<qsizetype>(column)), false);
    want.ideal += 2 * kPadX + 1;
    want.least += 2 * kPadX + 1;
    return want;
}

struct Part {
    std::vector<std::size_t> columns;
    std::vector<double> widths;
};

/// Columns in as many parts as the page's width makes necessary.
std::vector<Part> partsOf(const TableBlock& table) {
    std::vector<Want> wants;
    for (std::size_t i = 0; i < table.columns.size(); ++i) wants.push_back(wantOf(table, i));
    std::vector<Part> parts(1);
    double used = 0;
    for (std::size_t i = 0; i < wants.size(); ++i) {
        if (used + wants[i].least > PdfPages::kWidth && parts.back().columns.size() > 1) {
            parts.emplace_back();
            parts.back().columns.push_back(0);
            used = wants[0].least;
        }
        parts.back().columns.push_back(i);
        used += wants[i].least;
    }
    for (auto& part : parts) {
        double least = 0, ideal = 0;
        for (const auto column : part.columns) {
            least += wants[column].least;
            ideal += wants[column].ideal;
        }
        const double room = std::max(0.0, PdfPages::kWidth - least);
        const double share = ideal > least ? std::min(1.0, room / (ideal - least)) : 0;
        for (const auto column : part.columns) {
            part.widths.push_back(wants[column].least + share * (wants[column].ideal - wants[column].least));
        }
        // One column alone may still be too wide; it is wrapped inside the page.
        for (auto& width : part.widths) width = std::min(width, PdfPages::kWidth);
    }
    return parts;
}

class TableSetter {
public:
    TableSetter(PdfPages& pages, const TableBlock& table, const Part& part)
        : pages_(pages), table_(table), part_(part) {}

    [[nodiscard]] double headerHeight() const {
        return rowHeight([&](std::size_t c) { return table_.columns[c].title; }, true);
    }
    [[nodiscard]] double heightOf(const QStringList& row) const {
        return rowHeight([&](std::size_t c) { return row.value(static_cast<qsizetype>(c)); }, false);
    }

    void setHeader() {
        rule(ink::kText, 1);
        setRow([&](std::size_t c) { return table_.columns[c].title; }, true);
        rule(ink::kText, 0.7);
    }
    void setBody(const QStringList& row, bool last) {
        setRow([&](std::size_t c) { return row.value(static_cast<qsizetype>(c)); }, false);
        rule(last ? ink::kText : ink::kGrid, last ? 1 : 0.7);
    }

private:
    template <class Text>
    [[nodiscard]] double rowHeight(Text text, bool bold) const {
        double height = 0;
        for (std::size_t i = 0; i < part_.columns.size(); ++i) {
            height = std::max(height, PdfPages::textHeight(part_.widths[i] - 2 * kPadX, text(part_.columns[i]),
                                                           textFont(kSize, bold)));
        }
        return height + 2 * kPadY;
    }

    template <class Text>
    void setRow(Text text, bool bold) {
        const double height = rowHeight(text, bold);
        double x = 0;
        pages_.advance(kPadY);
        for (std::size_t i = 0; i < part_.columns.size(); ++i) {
            const auto column = part_.columns[i];
            pages_.text(x + kPadX, part_.widths[i] - 2 * kPadX, text(column), textFont(kSize, bold), ink::kText,
                        table_.columns[column].numeric ? Qt::AlignRight : Qt::AlignLeft);
            x += part_.widths[i];
        }
        pages_.advance(height - kPadY);
    }

    void rule(const QColor& color, double width) {
        auto* painter = pages_.painter();
        if (painter == nullptr) return;
        double total = 0;
        for (const double column : part_.widths) total += column;
        painter->setPen(QPen(color, width));
        painter->drawLine(QPointF(0, pages_.y()), QPointF(total, pages_.y()));
    }

    PdfPages& pages_;
    const TableBlock& table_;
    const Part& part_;
};

}  // namespace

void setTable(PdfPages& pages, const TableBlock& table) {
    const auto parts = partsOf(table);
    const QFont captionFont = textFont(12, true);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const QString caption = p == 0 ? table.caption : table.caption + ", continued to the right";
        TableSetter setter(pages, table, parts[p]);
        const double captionHeight = PdfPages::textHeight(PdfPages::kWidth, caption, captionFont) + 4;
        double start = captionHeight + setter.headerHeight();
        // A caption and header with at least two rows, or not on this page.
        for (std::size_t r = 0; r < std::min<std::size_t>(2, table.rows.size()); ++r)
            start += setter.heightOf(table.rows[r]);
        pages.require(start);
        pages.advance(pages.text(0, PdfPages::kWidth, caption, captionFont, ink::kText) + 4);
        setter.setHeader();
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            if (pages.require(setter.heightOf(table.rows[r]))) setter.setHeader();
            setter.setBody(table.rows[r], r + 1 == table.rows.size());
        }
        if (p + 1 < parts.size()) pages.advance(10);
    }
}

}  // namespace tacto
