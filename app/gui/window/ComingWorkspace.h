// ComingWorkspace.h - a workspace whose procedures do not exist yet: it says what will come, and what serves meanwhile.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>
#include <QWidget>

namespace tacto::gui {

class ComingWorkspace final : public QWidget {
    Q_OBJECT
public:
    ComingWorkspace(const QString& title, const QString& purpose, const QStringList& willCome, const QString& meanwhile,
                    QWidget* parent = nullptr);
};

}  // namespace tacto::gui
