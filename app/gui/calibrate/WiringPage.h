// WiringPage.h - how a stimulator, a load and an oscilloscope are connected: the drawing that the protocols' questions
// show, to be looked at before anything is run.
#pragma once

#include <QScrollArea>

namespace tacto::gui {

class WiringPage final : public QScrollArea {
    Q_OBJECT
public:
    explicit WiringPage(QWidget* parent = nullptr);
};

}  // namespace tacto::gui
