// ResultTables.h - the numbers that a protocol's verdict was given, as tables by the schema of their kind
// (ResultSchema.h).
//
// Thread-safety: the GUI thread.
#pragma once

#include <QVBoxLayout>
#include <QWidget>
#include <nlohmann/json.hpp>

#include "app/gui/runner/ResultSchema.h"

namespace tacto::gui {

class ResultTables final : public QWidget {
    Q_OBJECT
public:
    explicit ResultTables(QWidget* parent = nullptr);
    /// Replaces what is shown.
    void show(const nlohmann::json& results);
    [[nodiscard]] bool empty() const { return body_ == nullptr; }

private:
    void add(const ResultTable& table, const nlohmann::json& results);
    void addHeading(const QString& title);
    void addFacts(const ResultTable& table, const nlohmann::json& record);
    void addRows(const ResultTable& table, const nlohmann::json& records);
    void addSentences(const ResultTable& table, const nlohmann::json& sentences);
    void addConfusion(const ResultTable& table, const nlohmann::json& results);
    QVBoxLayout* layout_;
    QWidget* body_ = nullptr;
    QVBoxLayout* column_ = nullptr;
};

}  // namespace tacto::gui
