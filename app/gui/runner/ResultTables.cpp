#include "app/gui/runner/ResultTables.h"

#include <QFormLayout>
#include <QHeaderView>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QTreeWidget>

#include "app/gui/calibrate/CalibrationResult.h"
#include "app/gui/look/Look.h"
#include "app/gui/look/TableText.h"

namespace tacto::gui {

namespace {

QString titleOf(const QString& key) {
    const auto name = columnName(key);
    return name.title.isEmpty() ? key : name.title;
}

QJsonValue inQt(const nlohmann::json& value) {
    const auto wrapped = nlohmann::json{{"v", value}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return QJsonDocument::fromJson(QByteArray::fromStdString(wrapped)).object().value("v");
}

bool isOneCell(const nlohmann::json& value) {
    return value.is_primitive() || value.contains("mean") || (value.contains("value") && value.contains("low"));
}

bool isRows(const nlohmann::json& value) {
    return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), [](const auto& row) {
               return row.is_object() &&
                      std::all_of(row.begin(), row.end(), [](const auto& cell) { return isOneCell(cell); });
           });
}

bool isMatrix(const nlohmann::json& value) {
    return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), [&](const auto& row) {
               return row.is_array() && row.size() == value.front().size() &&
                      std::all_of(row.begin(), row.end(), [](const auto& cell) { return cell.is_primitive(); });
           });
}

/// What names a row stands first, how many it is of second; the rest as it comes.
QStringList columnsOf(const nlohmann::json& rows) {
    QStringList columns;
    for (const auto& row : rows) {
        for (const auto& [key, cell] : row.items()) {
            if (const auto name = QString::fromStdString(key); !columns.contains(name)) columns << name;
        }
    }
    const QStringList first{"name", "condition", "a", "b", "n"};
    std::stable_sort(columns.begin(), columns.end(), [&](const QString& one, const QString& other) {
        const auto rank = [&](const QString& key) { return first.contains(key) ? first.indexOf(key) : first.size(); };
        return rank(one) < rank(other);
    });
    return columns;
}

void grow(QTreeWidgetItem* item, const QString& key, const nlohmann::json& value) {
    item->setText(0, titleOf(key));
    if (isOneCell(value)) return item->setText(1, shownValue(value, key));
    int index = 0;
    for (const auto& [inner, part] : value.items()) {
        ++index;
        grow(new QTreeWidgetItem(item), value.is_array() ? QString::number(index) : QString::fromStdString(inner),
             part);
    }
}

}  // namespace

QString shownValue(const nlohmann::json& value, const QString& key) {
    if (value.is_boolean()) return value.get<bool>() ? QObject::tr("yes") : QObject::tr("no");
    if (value.is_object() && value.contains("value") && value["value"].is_number()) {
        const auto number = [&](const char* name) {
            const auto at = value.find(name);
            return at != value.end() && at->is_number() ? at->get<double>() : std::nan("");
        };
        Estimate estimate;
        estimate.value = number("value");
        estimate.low = number("low");
        estimate.high = number("high");
        // A share of a whole, where all three lie within 0 and 1 and the key names no unit.
        if (estimate.low >= 0 && estimate.high <= 1 && columnName(key).unit.isEmpty()) return proportionText(estimate);
    }
    return cellText(inQt(value), columnName(key).unit);
}

ResultTables::ResultTables(QWidget* parent) : QWidget(parent), layout_(new QVBoxLayout(this)) {
    layout_->setContentsMargins(0, 0, 0, 0);
}

void ResultTables::show(const nlohmann::json& results) {
    delete std::exchange(body_, nullptr);
    if (!results.is_object() || results.empty()) return;
    body_ = new QWidget(this);
    column_ = new QVBoxLayout(body_);
    column_->setContentsMargins(0, 0, 0, 0);
    addValues(results);
    for (const auto& [key, value] : results.items()) {
        if (key == "trials" || key == "reasons" || key == "kind" || isOneCell(value) || value.empty()) continue;
        const auto title = titleOf(QString::fromStdString(key));
        if (CalibrationResult::isCalibration(value))
            column_->addWidget(new CalibrationResult(key, value, body_));
        else if (isRows(value))
            addRows(title, value);
        else if (isMatrix(value))
            addMatrix(title, value, results);
        else
            addTree(title, value);
    }
    column_->addStretch();
    layout_->addWidget(body_);
}

void ResultTables::addValues(const nlohmann::json& results) {
    auto* form = new QFormLayout;
    for (const auto& [key, value] : results.items()) {
        const auto name = QString::fromStdString(key);
        if (key == "verdict" || key == "kind" || !isOneCell(value)) continue;
        auto* shown = new QLabel(shownValue(value, name), body_);
        shown->setTextFormat(Qt::PlainText);
        shown->setTextInteractionFlags(Qt::TextSelectableByMouse);
        form->addRow(titleOf(name), shown);
    }
    column_->addLayout(form);
}

QTableWidget* ResultTables::addTable(const QString& title, int rows, const QStringList& columns) {
    auto* above = new QLabel(title, body_);
    above->setTextFormat(Qt::PlainText);
    auto font = above->font();
    font.setBold(true);
    above->setFont(font);
    column_->addWidget(above);
    auto* table = new QTableWidget(rows, int(columns.size()), body_);
    table->setAccessibleName(title);
    table->setHorizontalHeaderLabels(columns);
    table->verticalHeader()->hide();
    table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table->setAlternatingRowColors(true);
    table->setWordWrap(false);
    table->setTabKeyNavigation(false);
    table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    table->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    column_->addWidget(table);
    return table;
}

void ResultTables::addRows(const QString& title, const nlohmann::json& rows) {
    const auto columns = columnsOf(rows);
    QStringList titles;
    for (const auto& key : columns) titles << titleOf(key);
    auto* table = addTable(title, int(rows.size()), titles);
    for (int c = 0; c < int(columns.size()); ++c) {
        const auto& key = columns[c];
        const auto unit = columnName(key).unit;
        std::vector<double> numbers;  // compared with each other: alike in prefix and decimals
        for (const auto& row : rows) {
            const auto at = row.find(key.toStdString());
            numbers.push_back(at != row.end() && at->is_number() ? at->get<double>() : std::nan(""));
        }
        const auto format = columnFormat(numbers, unit);
        for (int r = 0; r < int(rows.size()); ++r) {
            const auto& row = rows[std::size_t(r)];
            const auto at = row.find(key.toStdString());
            const double number = numbers[std::size_t(r)];
            const auto text = at == row.end()                   ? QString("–")
                              : format && std::isfinite(number) ? quantityText(number, unit, *format)
                                                                : shownValue(*at, key);
            putText(*table, r, c, text, at != row.end() && !at->is_string());
        }
    }
    fitToRows(*table);
}

void ResultTables::addMatrix(const QString& title, const nlohmann::json& rows, const nlohmann::json& results) {
    QStringList names;
    if (const auto at = results.find("conditions");
        at != results.end() && at->is_array() && at->size() == rows.size()) {
        for (const auto& condition : *at) {
            if (condition.is_object()) names << QString::fromStdString(condition.value("name", std::string()));
        }
    }
    const int columns = int(rows.front().size());
    const bool named = names.size() == qsizetype(rows.size()) && names.size() == columns;
    QStringList header{named ? tr("Presented ↓  recognised as →") : QString()};
    for (int c = 0; c < columns; ++c) header << (named ? names[c] : QString::number(c + 1));
    auto* table = addTable(title, int(rows.size()), header);
    for (int r = 0; r < int(rows.size()); ++r) {
        putText(*table, r, 0, named ? names[r] : QString::number(r + 1), false);
        for (int c = 0; c < columns; ++c)
            putText(*table, r, c + 1, shownValue(rows[std::size_t(r)][std::size_t(c)], {}), true);
    }
    fitToRows(*table);
}

void ResultTables::addTree(const QString& title, const nlohmann::json& value) {
    auto* tree = new QTreeWidget(body_);
    tree->setAccessibleName(title);
    tree->setHeaderLabels({tr("Result"), tr("Value")});
    tree->setAlternatingRowColors(true);
    auto* root = new QTreeWidgetItem(tree);
    grow(root, title, value);
    root->setText(0, title);
    root->setExpanded(true);
    tree->resizeColumnToContents(0);
    column_->addWidget(tree);
}

}  // namespace tacto::gui
