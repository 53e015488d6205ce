// PictureTools.h - what a plot is saved, copied and looked at alone with, as buttons: the same ones in every workspace.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLayout>
#include <QObject>
#include <QToolButton>
#include <array>
#include <functional>

#include "app/gui/theme/PlotPicture.h"

namespace tacto::gui {

class PictureTools final : public QObject {
    Q_OBJECT
public:
    /// `parent` is that of the buttons and of the dialog, and outlives this.
    explicit PictureTools(QWidget* parent);
    [[nodiscard]] QToolButton& save() const { return *save_; }
    [[nodiscard]] QToolButton& copy() const { return *copy_; }
    [[nodiscard]] QToolButton& plotOnly() const { return *plotOnly_; }
    [[nodiscard]] std::array<QToolButton*, 3> buttons() const { return {save_, copy_, plotOnly_}; }
    void addTo(QLayout& row);
    /// Save and copy take what `shown` gives when they are clicked; `name` is the file that is proposed.
    void takeFrom(const std::function<Still()>& shown, const QString& name);

signals:
    /// The plot without what is around it, or back.
    void plotOnlyWanted();

private:
    QToolButton* save_;
    QToolButton* copy_;
    QToolButton* plotOnly_;
};

}  // namespace tacto::gui
