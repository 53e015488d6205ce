// WiringPage.h - shows how to connect a stimulator, a load and an oscilloscope, before any run; the drawing is the one
// in the protocols' questions.
#pragma once

#include <QScrollArea>

namespace tacto::gui {

class WiringPage final : public QScrollArea {
    Q_OBJECT
public:
    explicit WiringPage(QWidget* parent = nullptr);
};

}  // namespace tacto::gui
