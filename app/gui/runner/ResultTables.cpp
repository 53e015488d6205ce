#include "app/gui/runner/ResultTables.h"

#include <QFormLayout>
#include <QLabel>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/TableText.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto::gui {

namespace {

using nlohmann::json;
using Shape = ResultTable::Shape;

}  // namespace

ResultTables::ResultTables(QWidget* parent) : QWidget(parent), layout_(new QVBoxLayout(this)) {
    setObjectName("resultTables");
    layout_->setContentsMargins(0, 0, 0, 0);
    afterLookChange(*this, [this] {
        for (auto* table : findChildren<QTableWidget*>()) layOutRecordTable(*table, width());
    });
}

void ResultTables::show(const json& results, const QString& none) {
    delete std::exchange(body_, nullptr);
    empty_ = !results.is_object() || results.empty();
    if (empty_ && none.isEmpty()) return;
    body_ = new QWidget(this);
    column_ = columnIn(*body_);
    for (const auto& table : empty_ ? std::vector<ResultTable>() : tablesOf(results)) {
        if (isInWindow(table.shown)) add(table, results);
    }
    if (column_->isEmpty()) setTone(*addSentence(none), Tone::Quiet);
    column_->addStretch();
    layout_->addWidget(body_);
    tabInPlace(*this);
}

void ResultTables::add(const ResultTable& table, const json& results) {
    const auto& value = table.at.empty() ? results : memberAt(results, table.at);
    switch (table.shape) {
        case Shape::Facts:
            if (value.is_object()) addFacts(table, value);
            break;
        case Shape::Rows:
            addRows(table, rowsOf(table, results));
            break;
        case Shape::Sentences:
            addSentences(table, value);
            break;
        case Shape::Confusion:
            addConfusion(table, countsText(table, results));
            break;
        case Shape::Limits:
        case Shape::Across:
            break;  // LimitMatrixView shows these
    }
}

void ResultTables::addHeading(const std::string& title) {
    auto* head = makeLabel(qtext(title), {.size = TextSize::Body, .strong = true, .wraps = true, .plain = true}, body_);
    column_->addSpacing(8);
    column_->addWidget(head);
}

void ResultTables::addFacts(const ResultTable& table, const json& record) {
    auto* holder = new QWidget(body_);
    auto* form = layoutIn<QFormLayout>(*holder, -1, {});
    form->setHorizontalSpacing(24);
    for (const auto& column : table.columns) {
        if (memberAt(record, column.at).is_null()) continue;
        auto one = columnText(column, json::array({record}));
        auto* shown = makeLabel(one.cells.first(), {.wraps = true, .plain = true, .selectable = true}, holder);
        auto* name = makeLabel(one.header.replace('\n', ' '), {.tone = Tone::Quiet, .plain = true}, holder);
        form->addRow(name, shown);
    }
    if (form->rowCount() == 0) return delete holder;
    holder->setAccessibleName(qtext(table.title));
    copyAsTable(*holder);
    addHeading(table.title);
    column_->addWidget(holder);
}

void ResultTables::addRows(const ResultTable& table, const json& records) {
    if (records.empty() || table.columns.empty()) return;
    addHeading(table.title);
    auto* made = makeRecordTable(table.columns, records, body_);
    made->setAccessibleName(qtext(table.title));
    column_->addWidget(made);
    addNote(table);
}

void ResultTables::addSentences(const ResultTable& table, const json& sentences) {
    const auto texts = sentencesIn(sentences);
    if (texts.isEmpty()) return;
    addHeading(table.title);
    for (const auto& text : texts) addSentence(capitalised(text));
}

QLabel* ResultTables::addSentence(const QString& text) {
    auto* line = makeLabel(text, {.wraps = true, .plain = true, .selectable = true}, body_);
    column_->addWidget(line);
    return line;
}

void ResultTables::addNote(const ResultTable& table) {
    if (!table.note.empty()) setTone(*addSentence(qtext(table.note)), Tone::Quiet);
}

void ResultTables::addConfusion(const ResultTable& table, const CountsText& text) {
    if (text.counts.empty()) return;
    addHeading(table.title);
    auto* made = new QTableWidget(int(text.down.size()), int(text.across.size()) + 1, body_);
    made->setAccessibleName(qtext(table.title));
    made->setHorizontalHeaderLabels(QStringList{tr("Presented ↓  recognised as →")} + text.across);
    for (int r = 0; r < made->rowCount(); ++r) {
        putText(*made, r, 0, text.down[r], false);
        for (int c = 1; c < made->columnCount(); ++c) putText(*made, r, c, text.counts[std::size_t(r)][c - 1], true);
    }
    layOutRecordTable(*made);
    column_->addWidget(made);
}

}  // namespace tacto::gui

#include "moc_ResultTables.cpp"
