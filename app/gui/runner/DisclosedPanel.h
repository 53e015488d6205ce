// DisclosedPanel.h - beside the limits x loads of a safety check: the outputs that a document asks to disclose, and the
// waveform of the strongest output that the run captured.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QWidget>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/measure/Capture.h"

class QScrollArea;

namespace tacto::gui {

class CaptureStrip;

class DisclosedPanel final : public QWidget {
    Q_OBJECT
public:
    explicit DisclosedPanel(QWidget* parent = nullptr);
    /// Before a run.
    void clear();
    /// Keeps the capture with the highest peak, of current where it is measured, else of voltage.
    void take(const std::shared_ptr<const Capture>& capture);
    /// `disclosed` as in the results of load-safety; anything else shows none.
    void show(const nlohmann::json& disclosed);
    using QWidget::show;
    /// In place of the strongest output, below `title`.
    void showTracing(const std::shared_ptr<const Capture>& capture, const QString& title);

private:
    QScrollArea* area_;
    QLabel* none_;
    QLabel* peak_;
    CaptureStrip* wave_;
    double strongest_ = -1;  ///< in the unit below
    QString unit_;
};

}  // namespace tacto::gui
