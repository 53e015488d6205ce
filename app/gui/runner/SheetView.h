// SheetView.h - a sheet of the report in the window, and the figure of a session that its results are read from.
//
// Thread-safety: readFigure() any thread; SheetView the GUI thread.
#pragma once

#include <QString>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "app/report/Figure.h"
#include "app/report/PlotSheet.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

/// A sheet of the report, as large as space allows.
class SheetView final : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;
    void show(std::unique_ptr<PlotSheet> sheet);
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::unique_ptr<PlotSheet> sheet_;
};

struct SessionFigure {
    std::optional<Figure> figure;  ///< the report's first figure that is not a plane of trials
    QString caption;
    bool planeOfTrials = false;  ///< the report has a plane of trials, which comes before other figures
};
/// A figure that cannot be drawn is left out.
[[nodiscard]] SessionFigure figureIn(const std::vector<SessionRow>& reportItems, const SessionReader& reader);
/// As figureIn(), of the session at `path`; without a figure if it cannot be read.
[[nodiscard]] SessionFigure readFigure(const std::filesystem::path& path);

}  // namespace tacto::gui
