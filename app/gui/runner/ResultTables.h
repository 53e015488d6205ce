// ResultTables.h - shows the numbers behind a protocol's verdict in the tables for that kind of result
// (core/results/ResultTable.h).
#pragma once

#include <QLabel>
#include <QVBoxLayout>
#include <QWidget>

#include "app/gui/theme/RecordColumns.h"

namespace tacto::gui {

class ResultTables final : public QWidget {
    Q_OBJECT
public:
    explicit ResultTables(QWidget* parent = nullptr);
    /// Replaces the tables shown. `none` stands in their place if the results have none.
    void show(const nlohmann::json& results, const QString& none = {});
    [[nodiscard]] bool empty() const { return empty_; }

private:
    void add(const ResultTable& table, const nlohmann::json& results);
    void addHeading(const std::string& title);
    void addFacts(const ResultTable& table, const nlohmann::json& record);
    void addRows(const ResultTable& table, const nlohmann::json& records);
    void addSentences(const ResultTable& table, const nlohmann::json& sentences);
    void addConfusion(const ResultTable& table, const CountsText& text);
    QLabel* addSentence(const QString& text);
    void addNote(const ResultTable& table);
    QVBoxLayout* layout_;
    QWidget* body_ = nullptr;
    bool empty_ = true;
    QVBoxLayout* column_ = nullptr;
};

}  // namespace tacto::gui
