#include "app/gui/theme/Told.h"

namespace tacto::gui {

Told& Told::all() {
    static Told told;
    return told;
}

void tell(const QString& what) { emit Told::all().said(what); }

}  // namespace tacto::gui

#include "moc_Told.cpp"
