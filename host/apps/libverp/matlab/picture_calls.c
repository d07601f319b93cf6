/* Camera pictures and renderings, in MATLAB's order: (row, column, colour). */
#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/verp.h"

/* A picture from rows, top first, with `deep` numbers per pixel. */
static mxArray* picture_of(const void* from, size_t height, size_t width, size_t deep,
                           size_t bytes) {
  const mwSize size[] = {(mwSize)height, (mwSize)width, (mwSize)deep};
  mxArray* made = mxCreateNumericArray(deep > 1 ? 3 : 2, size,
                                       bytes == 1 ? mxUINT8_CLASS : mxUINT16_CLASS, mxREAL);
  const char* in = from;
  char* out = mxGetData(made);
  for (size_t y = 0; y < height; ++y) {
    for (size_t x = 0; x < width; ++x) {
      for (size_t k = 0; k < deep; ++k)
        memcpy(out + bytes * (y + height * (x + width * k)),
               in + bytes * (deep * (width * y + x) + k), bytes);
    }
  }
  return made;
}

/* session_picture(session, robot, camera, what): the picture and its time; empty: none yet. */
void session_picture(const arguments* a) {
  const uint32_t robot = whole(a, 1, "robot"), index = whole(a, 2, "camera");
  const uint32_t what = whole(a, 3, "what");
  verp_camera camera = {.size = sizeof camera};
  checked(verp_session_camera(handle(a), robot, index, &camera));
  const size_t deep = what == VERP_COLOUR ? 3 : 1, bytes = what == VERP_COLOUR ? 1 : 2;
  const size_t size = deep * bytes * camera.width * camera.height;
  void* pixels = mxMalloc(size);
  double time_s = 0;
  const int status =
      checked(verp_session_picture(handle(a), robot, index, what, pixels, size, &time_s));
  const int seen = status != VERP_NO_PICTURE;
  a->out[0] = seen ? picture_of(pixels, camera.height, camera.width, deep, bytes)
                   : mxCreateDoubleMatrix(0, 0, mxREAL);
  if (a->wanted > 1)
    a->out[1] = seen ? mxCreateDoubleScalar(time_s) : mxCreateDoubleMatrix(0, 0, mxREAL);
  mxFree(pixels);
}

static void place(const arguments* a, int index, const char* what, double* to) {
  if (index >= a->given || !mxIsDouble(a->in[index]) || mxIsComplex(a->in[index]) ||
      mxGetNumberOfElements(a->in[index]) != 3) {
    refuse("%s: three numbers are needed", what);
  }
  memcpy(to, mxGetPr(a->in[index]), 3 * sizeof *to);
}

/* session_render(session, name, width, height, robot, plain, eye, target, fov); with a name, the
 * last three may be missing. */
void session_render(const arguments* a) {
  verp_view view = {.size = sizeof view,
                    .flags = number(a, 5, "plain") != 0 ? VERP_PLAIN : 0,
                    .width = whole(a, 2, "width"),
                    .height = whole(a, 3, "height"),
                    .name = text(a, 1, "view"),
                    .robot = whole(a, 4, "robot")};
  if (view.name == NULL) {
    place(a, 6, "eye", view.eye_m);
    place(a, 7, "target", view.target_m);
    view.fov_rad = number(a, 8, "fov");
  }
  const int drawn = view.width <= VERP_MOST_PIXELS && view.height <= VERP_MOST_PIXELS;
  const size_t size = drawn ? (size_t)3 * view.width * view.height : 0; /* if not, it is refused */
  void* pixels = mxMalloc(size + 1);
  checked(verp_session_render(handle(a), &view, pixels, size));
  a->out[0] = picture_of(pixels, view.height, view.width, 3, 1);
  mxFree(pixels);
}
