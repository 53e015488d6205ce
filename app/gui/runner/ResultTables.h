// ResultTables.h - the numbers that a protocol's verdict was given, laid out for reading: single values in a form,
// lists of rows as tables, matrices with the names of the conditions; anything else as a tree.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QString>
#include <QTableWidget>
#include <QVBoxLayout>
#include <QWidget>
#include <nlohmann/json.hpp>

namespace tacto::gui {

class ResultTables final : public QWidget {
    Q_OBJECT
public:
    explicit ResultTables(QWidget* parent = nullptr);
    /// Replaces what is shown. What stands elsewhere (verdict, reasons, the trials) is left out.
    void show(const nlohmann::json& results);
    [[nodiscard]] bool empty() const { return body_ == nullptr; }

private:
    void addValues(const nlohmann::json& results);
    void addRows(const QString& title, const nlohmann::json& rows);
    void addMatrix(const QString& title, const nlohmann::json& rows, const nlohmann::json& results);
    void addTree(const QString& title, const nlohmann::json& value);
    QTableWidget* addTable(const QString& title, int rows, const QStringList& columns);
    QVBoxLayout* layout_;
    QWidget* body_ = nullptr;
    QVBoxLayout* column_ = nullptr;
};

/// A value as a cell of a table shows it: a number with its unit, a statistic, an estimate, yes or no.
[[nodiscard]] QString shownValue(const nlohmann::json& value, const QString& key);

}  // namespace tacto::gui
