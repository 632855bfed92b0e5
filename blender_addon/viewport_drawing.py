def register(): pass
def unregister(): pass
def tag_redraw(): pass
