// Widgets.h - the parts of Qt and QCustomPlot that most files of the window use, for precompiled headers; sources still
// include what they use.
//
// <QtWidgets> would include all of Qt's core and drawing: 450 MB precompiled, which each file takes two seconds to
// load. So would the printing header in qcustomplot.h, which needs only the printer.
//
// Thread-safety: Qt's: widgets belong to the main thread.
#pragma once

#include <QApplication>
#include <QBoxLayout>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QElapsedTimer>
#include <QEvent>
#include <QFileInfo>
#include <QFormLayout>
#include <QFrame>
#include <QGridLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QRegularExpression>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QSpinBox>
#include <QSplitter>
#include <QStackedWidget>
#include <QStringList>
#include <QTabWidget>
#include <QTableWidget>
#include <QTextBrowser>
#include <QTimer>
#include <QToolButton>
#include <QtPrintSupport/QPrinter>

#define QT_QTPRINTSUPPORT_MODULE_H  // defined as if it had been included
#include <qcustomplot.h>
#undef QT_QTPRINTSUPPORT_MODULE_H
