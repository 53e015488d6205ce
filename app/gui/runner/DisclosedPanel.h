// DisclosedPanel.h - the panel next to the matrix of limits and loads of a safety check: the waveform of the strongest
// captured output or of a chosen cell, and the outputs that a document asks to disclose.
#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QWidget>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/measure/Capture.h"

class QScrollArea;
class QTableWidget;

namespace tacto::gui {

class CaptureStrip;

class DisclosedPanel final : public QWidget {
    Q_OBJECT
public:
    explicit DisclosedPanel(QWidget* parent = nullptr);
    /// Empties the panel before a run.
    void clear();
    /// Keeps the capture with the highest peak: of current if measured, otherwise of voltage.
    void take(const std::shared_ptr<const Capture>& capture);
    /// `disclosed`: as in the results of load-safety, with one column per load; any other value shows nothing.
    void show(const nlohmann::json& disclosed);
    using QWidget::show;
    /// Shows the outputs next to the tracing, below it (scrolling across in a narrow page), or not at all if there is
    /// no room for both.
    enum class Outputs { Beside, Below, BelowNarrow, Nowhere };
    void showOutputs(Outputs outputs);
    /// Returns the smallest height at which a tracing is readable.
    [[nodiscard]] int leastHeight() const;
    /// Returns the height at which outputs next to the tracing need not scroll.
    [[nodiscard]] int wholeHeight() const;
    /// Shows this tracing, under `title`, instead of the strongest output.
    void showTracing(const std::shared_ptr<const Capture>& capture, const QString& title);
    [[nodiscard]] CaptureStrip& tracing() const { return *wave_; }

private:
    void fitWidth();
    QBoxLayout* layout_;
    bool narrow_ = false;
    QWidget* outputs_;
    QTableWidget* table_;
    QScrollArea* area_;
    QLabel* none_;
    QLabel* peak_;
    CaptureStrip* wave_;
    double strongest_ = -1;  ///< in the unit below
    QString unit_;
};

}  // namespace tacto::gui
