/* What the listing in docs/c.md uses of the core Flight Executive's header. */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
typedef uint32_t uint32;
typedef int32_t int32;
typedef struct { uint32 words[4]; } CFE_MSG_Message_t;
typedef struct { CFE_MSG_Message_t Msg; } CFE_MSG_CommandHeader_t;
typedef struct { CFE_MSG_Message_t Msg; } CFE_MSG_TelemetryHeader_t;
typedef union { CFE_MSG_Message_t Msg; double aligned; } CFE_SB_Buffer_t;
typedef uint32 CFE_SB_PipeId_t;
typedef uint32 CFE_SB_MsgId_t;
#define CFE_MSG_PTR(header) (&(header).Msg)
#define CFE_SUCCESS 0
#define CFE_SB_PEND_FOREVER (-1)
#define CFE_EVS_EventFilter_BINARY 0
enum { CFE_EVS_EventType_ERROR = 3, CFE_EVS_EventType_CRITICAL = 4 };
enum { CFE_ES_RunStatus_APP_RUN = 1, CFE_ES_RunStatus_APP_ERROR = 3 };
int32 CFE_EVS_Register(const void *filters, uint32 count, uint32 scheme);
int32 CFE_EVS_SendEvent(uint32 id, uint32 type, const char *format, ...);
int32 CFE_SB_CreatePipe(CFE_SB_PipeId_t *pipe, uint32 depth, const char *name);
int32 CFE_SB_Subscribe(CFE_SB_MsgId_t id, CFE_SB_PipeId_t pipe);
CFE_SB_MsgId_t CFE_SB_ValueToMsgId(uint32 value);
int32 CFE_SB_ReceiveBuffer(CFE_SB_Buffer_t **buffer, CFE_SB_PipeId_t pipe, int32 timeout);
void CFE_SB_TimeStampMsg(CFE_MSG_Message_t *message);
int32 CFE_SB_TransmitMsg(CFE_MSG_Message_t *message, bool increments);
int32 CFE_MSG_Init(CFE_MSG_Message_t *message, CFE_SB_MsgId_t id, size_t size);
bool CFE_ES_RunLoop(uint32 *status);
void CFE_ES_ExitApp(uint32 status);
