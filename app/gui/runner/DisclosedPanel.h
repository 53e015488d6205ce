// DisclosedPanel.h - what belongs to the limits x loads of a safety check: the waveform of the strongest output that
// the run captured, or of a chosen cell, and beside or below it the outputs that a document asks to disclose.
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
    /// Keeps the capture with the highest peak, of current where it is measured, else of voltage.
    void take(const std::shared_ptr<const Capture>& capture);
    /// `disclosed` as in the results of load-safety, a column for each load; anything else shows none.
    void show(const nlohmann::json& disclosed);
    using QWidget::show;
    /// The outputs beside the tracing, below it, or nowhere where there is no room for both.
    enum class Outputs { Beside, Below, Nowhere };
    void showOutputs(Outputs outputs);
    /// The height from which a tracing can be read.
    [[nodiscard]] int leastHeight() const;
    /// Replaces the strongest output by the tracing, under `title`.
    void showTracing(const std::shared_ptr<const Capture>& capture, const QString& title);
    [[nodiscard]] CaptureStrip& tracing() const { return *wave_; }

private:
    QBoxLayout* layout_;
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
