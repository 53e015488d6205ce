// RailButton.h - one workspace in the rail at the left: an icon over its word, both from the same edge; the chosen one
// has a bar at its left.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QToolButton>

namespace tacto::gui {

class RailButton final : public QToolButton {
    Q_OBJECT
public:
    RailButton(QAction* action, QString iconName, QWidget* parent);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString icon_;
};

}  // namespace tacto::gui
