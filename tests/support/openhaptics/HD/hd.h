// The part of the OpenHaptics device interface that simulation/device/openhaptics uses, declared
// anew from its public documentation, so that it is compiled and tested where the library is not.
// Numbers are this stub's own. tests/support/fake_openhaptics.h says what stands behind it.
#pragma once

typedef unsigned int HHD, HDenum, HDerror, HDCallbackCode;
typedef unsigned long HDSchedulerHandle;
typedef unsigned short HDushort;
typedef int HDint;
typedef double HDdouble;
typedef const char* HDstring;
#define HDCALLBACK
typedef HDCallbackCode (*HDSchedulerCallback)(void*);
struct HDErrorInfo {
  HDerror errorCode;
  int internalErrorCode;
  HHD hHD;
};
#define HD_DEVICE_ERROR(X) ((X).errorCode != HD_SUCCESS)
#define HD_DEFAULT_DEVICE (static_cast<HDstring>(nullptr))

constexpr HHD HD_INVALID_HANDLE = 0xffffffffu;
constexpr HDushort HD_MAX_SCHEDULER_PRIORITY = 0xffff;
enum : unsigned int { HD_CALLBACK_DONE, HD_CALLBACK_CONTINUE };
enum : unsigned int {
  HD_SUCCESS,
  HD_WARM_MOTORS,
  HD_EXCEEDED_MAX_FORCE,
  HD_EXCEEDED_MAX_FORCE_IMPULSE,
  HD_EXCEEDED_MAX_VELOCITY,
  HD_FORCE_ERROR,
  HD_DEVICE_FAULT,
  HD_COMM_ERROR
};
enum : unsigned int {
  HD_CALIBRATION_OK,
  HD_CALIBRATION_NEEDS_UPDATE,
  HD_CALIBRATION_NEEDS_MANUAL_INPUT
};
enum : unsigned int {
  HD_CURRENT_POSITION = 100,
  HD_CURRENT_TRANSFORM,
  HD_CURRENT_BUTTONS,
  HD_CURRENT_FORCE,
  HD_CALIBRATION_STYLE,
  HD_INPUT_DOF,
  HD_OUTPUT_DOF,
  HD_NOMINAL_MAX_FORCE,
  HD_NOMINAL_MAX_CONTINUOUS_FORCE,
  HD_NOMINAL_MAX_STIFFNESS,
  HD_USABLE_WORKSPACE_DIMENSIONS,
  HD_DEVICE_MODEL_TYPE,
  HD_DEVICE_SERIAL_NUMBER,
  HD_FORCE_OUTPUT
};

HHD hdInitDevice(HDstring name);
void hdDisableDevice(HHD device);
void hdMakeCurrentDevice(HHD device);
void hdEnable(HDenum capability);
void hdBeginFrame(HHD device);
void hdEndFrame(HHD device);
void hdGetDoublev(HDenum what, HDdouble* values);
void hdGetIntegerv(HDenum what, HDint* values);
HDstring hdGetString(HDenum what);
void hdSetDoublev(HDenum what, const HDdouble* values);
HDenum hdCheckCalibration();
void hdUpdateCalibration(HDenum style);
HDErrorInfo hdGetError();
HDstring hdGetErrorString(HDerror error);
void hdStartScheduler();
void hdStopScheduler();
HDSchedulerHandle hdScheduleAsynchronous(HDSchedulerCallback callback, void* data,
                                         HDushort priority);
void hdScheduleSynchronous(HDSchedulerCallback callback, void* data, HDushort priority);
void hdUnschedule(HDSchedulerHandle handle);
