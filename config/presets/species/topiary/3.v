angle increment: 60
