// The EGL and OpenGL calls in use: PBF_EGL / PBF_GL(result, name, arguments). One marked OPTIONAL
// is newer than OpenGL 3.3 or an extension, and used only where the driver says that it has it.

#ifdef PBF_EGL
PBF_EGL(EGLBoolean, eglBindAPI, (EGLenum api))
PBF_EGL(
    EGLBoolean,
    eglChooseConfig,
    (EGLDisplay display, const EGLint* attributes, EGLConfig* configs, EGLint size, EGLint* count))
PBF_EGL(EGLContext,
        eglCreateContext,
        (EGLDisplay display, EGLConfig config, EGLContext share, const EGLint* attributes))
PBF_EGL(EGLSurface,
        eglCreatePbufferSurface,
        (EGLDisplay display, EGLConfig config, const EGLint* attributes))
PBF_EGL(EGLBoolean, eglDestroyContext, (EGLDisplay display, EGLContext context))
PBF_EGL(EGLBoolean, eglDestroySurface, (EGLDisplay display, EGLSurface surface))
PBF_EGL(EGLContext, eglGetCurrentContext, ())
PBF_EGL(EGLDisplay, eglGetCurrentDisplay, ())
PBF_EGL(EGLSurface, eglGetCurrentSurface, (EGLint which))
PBF_EGL(EGLint, eglGetError, ())
PBF_EGL(AnyFunction, eglGetProcAddress, (const char* name))
PBF_EGL(EGLBoolean, eglInitialize, (EGLDisplay display, EGLint* major, EGLint* minor))
PBF_EGL(EGLBoolean,
        eglMakeCurrent,
        (EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context))
PBF_EGL(EGLenum, eglQueryAPI, ())
PBF_EGL(const char*, eglQueryString, (EGLDisplay display, EGLint name))
#endif

#ifdef PBF_EGL_OPTIONAL
PBF_EGL_OPTIONAL(EGLDisplay,
                 eglGetPlatformDisplayEXT,
                 (EGLenum platform, void* native, const EGLint* attributes))
PBF_EGL_OPTIONAL(EGLBoolean, eglQueryDevicesEXT, (EGLint size, EGLDevice* devices, EGLint* count))
PBF_EGL_OPTIONAL(EGLBoolean,
                 eglQueryDeviceAttribEXT,
                 (EGLDevice device, EGLint name, EGLAttrib* value))
PBF_EGL_OPTIONAL(const char*, eglQueryDeviceStringEXT, (EGLDevice device, EGLint name))
#endif

#ifdef PBF_GL
PBF_GL(void, glActiveTexture, (GLenum unit))
PBF_GL(void, glAttachShader, (GLuint program, GLuint shader))
PBF_GL(void, glBindAttribLocation, (GLuint program, GLuint index, const char* name))
PBF_GL(void, glBindBuffer, (GLenum target, GLuint buffer))
PBF_GL(void, glBindBufferBase, (GLenum target, GLuint index, GLuint buffer))
PBF_GL(void, glBindFramebuffer, (GLenum target, GLuint framebuffer))
PBF_GL(void, glBindTexture, (GLenum target, GLuint texture))
PBF_GL(void, glBindVertexArray, (GLuint array))
PBF_GL(void, glBlendEquation, (GLenum mode))
PBF_GL(void, glBlendFunc, (GLenum source, GLenum target))
PBF_GL(void,
       glBlitFramebuffer,
       (GLint x0,
        GLint y0,
        GLint x1,
        GLint y1,
        GLint to_x0,
        GLint to_y0,
        GLint to_x1,
        GLint to_y1,
        GLbitfield what,
        GLenum filter))
PBF_GL(void, glBufferData, (GLenum target, GLsizeiptr bytes, const void* data, GLenum usage))
PBF_GL(GLenum, glCheckFramebufferStatus, (GLenum target))
PBF_GL(void, glClearBufferfv, (GLenum buffer, GLint index, const GLfloat* value))
PBF_GL(void, glCompileShader, (GLuint shader))
PBF_GL(GLuint, glCreateProgram, ())
PBF_GL(GLuint, glCreateShader, (GLenum type))
PBF_GL(void, glCullFace, (GLenum face))
PBF_GL(void, glDeleteBuffers, (GLsizei count, const GLuint* names))
PBF_GL(void, glDeleteFramebuffers, (GLsizei count, const GLuint* names))
PBF_GL(void, glDeleteProgram, (GLuint program))
PBF_GL(void, glDeleteShader, (GLuint shader))
PBF_GL(void, glDeleteTextures, (GLsizei count, const GLuint* names))
PBF_GL(void, glDeleteVertexArrays, (GLsizei count, const GLuint* names))
PBF_GL(void, glDepthFunc, (GLenum relation))
PBF_GL(void, glDisable, (GLenum capability))
PBF_GL(void, glDrawArrays, (GLenum mode, GLint first, GLsizei count))
PBF_GL(void, glDrawArraysInstanced, (GLenum mode, GLint first, GLsizei count, GLsizei instances))
PBF_GL(void, glDrawBuffers, (GLsizei count, const GLenum* buffers))
PBF_GL(void, glEnable, (GLenum capability))
PBF_GL(void, glEnableVertexAttribArray, (GLuint index))
PBF_GL(void, glFinish, ())
PBF_GL(void,
       glFramebufferTexture2D,
       (GLenum target, GLenum attachment, GLenum texture_target, GLuint texture, GLint level))
PBF_GL(void, glGenBuffers, (GLsizei count, GLuint* names))
PBF_GL(void, glGenFramebuffers, (GLsizei count, GLuint* names))
PBF_GL(void, glGenTextures, (GLsizei count, GLuint* names))
PBF_GL(void, glGenVertexArrays, (GLsizei count, GLuint* names))
PBF_GL(void, glGenerateMipmap, (GLenum target))
PBF_GL(GLenum, glGetError, ())
PBF_GL(void, glGetIntegerv, (GLenum name, GLint* value))
PBF_GL(void, glGetProgramInfoLog, (GLuint program, GLsizei size, GLsizei* length, char* log))
PBF_GL(void, glGetProgramiv, (GLuint program, GLenum name, GLint* value))
PBF_GL(void, glGetShaderInfoLog, (GLuint shader, GLsizei size, GLsizei* length, char* log))
PBF_GL(void, glGetShaderiv, (GLuint shader, GLenum name, GLint* value))
PBF_GL(const unsigned char*, glGetString, (GLenum name))
PBF_GL(GLuint, glGetUniformBlockIndex, (GLuint program, const char* name))
PBF_GL(GLint, glGetUniformLocation, (GLuint program, const char* name))
PBF_GL(void, glLinkProgram, (GLuint program))
PBF_GL(void, glPixelStorei, (GLenum name, GLint value))
PBF_GL(void, glReadBuffer, (GLenum buffer))
PBF_GL(void,
       glReadPixels,
       (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void* data))
PBF_GL(void,
       glShaderSource,
       (GLuint shader, GLsizei count, const char* const* strings, const GLint* lengths))
PBF_GL(void,
       glTexImage2D,
       (GLenum target,
        GLint level,
        GLint internal_format,
        GLsizei width,
        GLsizei height,
        GLint border,
        GLenum format,
        GLenum type,
        const void* data))
PBF_GL(void, glTexParameteri, (GLenum target, GLenum name, GLint value))
PBF_GL(void,
       glTexSubImage2D,
       (GLenum target,
        GLint level,
        GLint x,
        GLint y,
        GLsizei width,
        GLsizei height,
        GLenum format,
        GLenum type,
        const void* data))
PBF_GL(void, glUniform1f, (GLint location, GLfloat x))
PBF_GL(void, glUniform1i, (GLint location, GLint x))
PBF_GL(void, glUniform2i, (GLint location, GLint x, GLint y))
PBF_GL(void, glUniform3f, (GLint location, GLfloat x, GLfloat y, GLfloat z))
PBF_GL(void, glUniformBlockBinding, (GLuint program, GLuint index, GLuint binding))
PBF_GL(void, glUseProgram, (GLuint program))
PBF_GL(void, glVertexAttribDivisor, (GLuint index, GLuint divisor))
PBF_GL(void,
       glVertexAttribPointer,
       (GLuint index,
        GLint size,
        GLenum type,
        GLboolean normalized,
        GLsizei stride,
        const void* offset))
PBF_GL(void, glViewport, (GLint x, GLint y, GLsizei width, GLsizei height))
#endif

#ifdef PBF_GL_OPTIONAL
PBF_GL_OPTIONAL(void, glBlendEquationi, (GLuint buffer, GLenum mode))
PBF_GL_OPTIONAL(void, glDebugMessageCallback, (DebugCallback callback, const void* user))
#endif
