// Told.h - one sentence about what was done, such as where a file went. The window shows it in the line at its bottom.
#pragma once

#include <QObject>
#include <QString>

namespace tacto::gui {

class Told final : public QObject {
    Q_OBJECT
public:
    [[nodiscard]] static Told& all();

signals:
    void said(const QString& what);
};

void tell(const QString& what);

}  // namespace tacto::gui
